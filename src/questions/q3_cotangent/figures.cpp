#include <cmath>

#include "base/number_text.h"
#include "questions/core/six_view_figure.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

double beyond_range(const Vector& values, const output::ColorRange& range) {
    int beyond = 0, finite = 0;
    for (const double v : values) {
        finite += std::isfinite(v) ? 1 : 0;
        beyond += v < range.low || v > range.high ? 1 : 0;
    }
    return finite > 0 ? double(beyond) / finite : 0;
}

output::ColorRange cotangent_range(const CotangentComparison& c) {
    output::Panel panel;
    panel.values = c.subject.mean_edge * c.cotangent;
    return output::robust_range({panel}, "diverging", "H × mean edge", "", 0.01);
}

void add_comparison_figure(Answer& answer, const Comparisons& meshes) {
    SixViewFigure figure{.id = "q3_h", .title = words.line("comparison.title"), .frame_panel = -1, .turnable = true, .view_files = true};
    int masked = 0;
    for (const CotangentComparison& c : meshes) {
        const CurvatureSubject& s = c.subject;
        const double range = cotangent_range(c).high;
        const auto add = [&](const char* key, const char* zero, const std::string& name, const Vector& values) {
            const bool coloured = s.mean_edge * largest_magnitude(values) > 0.01 * range;
            const std::string label = words.line(coloured ? key : zero, "mesh"_a = s.name(), "range"_a = readable(range, 2));
            figure.panels.push_back(relative_panel(s, "q3_" + s.name() + "_h_" + name, label, s.mean_edge * values, range));
        };
        add("comparison.uniform", "comparison.uniform.zero", "uniform", c.uniform);
        add("comparison.cotangent", "comparison.cotangent.zero", "cotangent", c.cotangent);
        masked += undefined_vertices(s);
    }
    figure.caption = words.line("comparison.caption", "undefined"_a = undefined_words(masked));
    figure.range = relative_range(figure.panels, words.line("comparison.quantity"));
    add_figure(answer, std::move(figure));
}

/// Curvature is a magnitude here: the sign of a flat surface's H is that of rounding.
void add_plane_figure(Answer& answer, const PlaneTest& plane, const std::string& colormap) {
    SixViewFigure figure{.id = "q3_h_irregular_plane",
                         .title = words.line("plane.title"),
                         .subtitle = words.line("plane.subtitle", "vertices"_a = plane.mesh.vertex_count()),
                         .caption = words.line("plane.caption", "uniform"_a = readable(plane.uniform),
                                               "cotangent"_a = readable(plane.cotangent, 2), "clamped"_a = readable(plane.clamped)),
                         .panels = {panel_of(plane.mesh, "q3_uniform_irregular_plane", "uniform, × 4/h²", plane.uniform_H.cwiseAbs()),
                                    panel_of(plane.mesh, "q3_cotangent_irregular_plane", "cotangent", plane.cotangent_H.cwiseAbs()),
                                    panel_of(plane.mesh, "q3_clamped_irregular_plane", "cotangent, clamped", plane.clamped_H.cwiseAbs())},
                         .edges = true};
    figure.range = range_from_zero(figure.panels, colormap, "|H| × mean edge", 0.01);
    add_figure(answer, std::move(figure));
}

void add_disagreement_figure(Answer& answer, const CotangentComparison& c, const Disagreement& d, const std::string& colormap) {
    const CurvatureSubject& s = c.subject;
    const std::string id = "q3_" + s.name() + "_disagreement";
    SixViewFigure figure{.id = id,
                         .title = words.line("disagreement.title"),
                         .subtitle = subtitle_of(*s.source),
                         .caption = words.line("disagreement.caption", "mesh"_a = s.name(), "undefined"_a = undefined_words(s)),
                         .panels = {panel_of(*s.source, id, s.name(), s.mean_edge * d.size)}};
    figure.range = range_from_zero(figure.panels, colormap, "|ΔH| × mean edge", 0.001);
    add_figure(answer, std::move(figure));
}

}   // namespace meshfolio::q3_cotangent
