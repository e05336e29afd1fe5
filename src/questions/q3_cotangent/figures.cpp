#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

double cotangent_range(const CotangentComparison& c) {
    output::Panel panel;
    panel.values = c.subject.mean_edge * c.cotangent;
    return output::robust_range({panel}, "diverging", "", "", 0.01).high;
}

void add_comparison_figure(Answer& answer, const Comparisons& meshes) {
    output::FigureRequest figure{.id = "q3_h",
                                 .title = words.line("comparison.title"),
                                 .range = relative_range(words.line("comparison.quantity")),
                                 .frame_panel = -1,
                                 .turnable = true,
                                 .view_files = true};
    UndefinedVertices masked;
    for (const CotangentComparison& c : meshes) {
        const CurvatureSubject& s = c.subject;
        const double range = cotangent_range(c);
        const auto add = [&](const char* key, const char* zero, const std::string& name, const Vector& values) {
            const double most = s.mean_edge * largest_magnitude(values);
            const std::string label = words.line(most > 0.01 * range ? key : zero, "mesh"_a = s.name(), "range"_a = readable(range, 2),
                                                 "most"_a = readable(most, 2), "beyond"_a = beyond_words(s.mean_edge * values, range));
            figure.panels.push_back(relative_panel(s, "q3_" + s.name() + "_h_" + name, label, s.mean_edge * values, range));
        };
        add("comparison.uniform", "comparison.uniform.zero", "uniform", c.uniform);
        add("comparison.cotangent", "comparison.cotangent.zero", "cotangent", c.cotangent);
        masked += undefined_vertices(s);
    }
    add_figure(answer, std::move(figure), words.line("comparison.caption", "undefined"_a = undefined_words(masked)));
}

/// Curvature is a magnitude here: the sign of a flat surface's H is that of rounding.
void add_plane_figure(Answer& answer, const PlaneTest& plane, const std::string& colormap) {
    output::FigureRequest figure{
        .id = "q3_h_irregular_plane", .title = words.line("plane.title"), .edges = true, .layout = output::Layout::multiples};
    const auto show = [&](const std::string& name, const Vector& H, double most) {
        figure.panels.push_back(panel_of(plane.mesh, "q3_" + name + "_irregular_plane",
                                         words.line("plane." + name, "most"_a = readable(most, 2)), H.cwiseAbs()));
    };
    show("uniform", plane.uniform_H, plane.uniform);
    show("cotangent", plane.cotangent_H, plane.cotangent);
    show("clamped", plane.clamped_H, plane.clamped);
    figure.range = range_from_zero(figure.panels, colormap, "|H| × mean edge", 0.01);
    add_figure(answer, std::move(figure), words.line("plane.caption", "vertices"_a = plane.mesh.vertex_count()));
}

void add_disagreement_figure(Answer& answer, const CotangentComparison& c, const Disagreement& d, const std::string& colormap) {
    const CurvatureSubject& s = c.subject;
    const std::string id = "q3_" + s.name() + "_disagreement";
    output::FigureRequest figure{.id = id,
                                 .title = words.line("disagreement.title"),
                                 .subtitle = subtitle_of(*s.source),
                                 .panels = {panel_of(*s.source, id, s.name(), s.mean_edge * d.size)}};
    figure.range = range_from_zero(figure.panels, colormap, words.line("disagreement.quantity"), 0.001);
    add_figure(answer, std::move(figure), words.line("disagreement.caption", "mesh"_a = s.name(), "undefined"_a = undefined_words(s)));
}

}   // namespace meshfolio::q3_cotangent
