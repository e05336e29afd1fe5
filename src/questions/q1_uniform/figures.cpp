#include <algorithm>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/six_view_figure.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// A quantity that every mesh shows on a range of its own, for values of meshes are not compared.
struct Shown {
    std::string key;   // the end of its figure's name
    const char *title, *caption, *quantity, *label;
    double floor;   // of the range: what is smaller is not seen
    Vector (*values)(const MeshCurvature&);
};

const Shown shown[]{
    {"h", "h.title", "h.caption", "h.quantity", "h.label", 0.1,
     [](const MeshCurvature& c) -> Vector { return 100 / c.subject.mean_edge * c.length; }},
    {"k", "k.title", "k.caption", "k.quantity", "k.label", 0.1,
     [](const MeshCurvature& c) -> Vector { return c.subject.diagonal * c.subject.diagonal * c.K; }},
};

/// Meshes of all sizes in one frame: each in the unit ball.
TriangleMesh in_the_unit_ball(TriangleMesh mesh) {
    mesh.X.rowwise() -= bounding_box(mesh).centre().transpose();
    const double radius = mesh.X.rowwise().norm().maxCoeff();
    if (radius > 0) mesh.X /= radius;
    return mesh;
}

/// In percent of the mesh's own range, which its label tells.
output::Panel relative_panel(const Shown& quantity, const MeshCurvature& c) {
    const std::string& name = c.subject.name();
    output::Panel panel = panel_of(in_the_unit_ball(c.subject.mesh()), "q1_" + name + "_" + quantity.key, name, quantity.values(c));
    const double range = output::robust_range({panel}, "diverging", "", "", quantity.floor).high;
    const bool coloured = largest_magnitude(panel.values) > 0.01 * range;
    panel.label = words.line(coloured ? quantity.label : "label.zero", "mesh"_a = name, "range"_a = readable(range, 2));
    panel.values *= 100 / range;
    return panel;
}

}   // namespace

void add_figures(Answer& answer, const Meshes& meshes) {
    int masked = 0;
    for (const MeshCurvature& c : meshes) masked += undefined_vertices(c.subject);
    for (const Shown& quantity : shown) {
        SixViewFigure figure{.id = "q1_" + quantity.key, .title = words.line(quantity.title)};
        for (const MeshCurvature& c : meshes) figure.panels.push_back(relative_panel(quantity, c));
        figure.caption = words.line(quantity.caption, "undefined"_a = undefined_words(masked));
        const output::ColorRange range{
            .colormap = "diverging", .low = -100, .high = 100, .quantity = words.line(quantity.quantity), .unit = words.line("own_range")};
        figure.range = range_for(range, figure.panels);
        figure.frame_panel = -1;
        figure.view_files = true;
        add_figure(answer, std::move(figure));
    }
}

void add_tangential_figure(Answer& answer, const MeshCurvature& c, const TangentialPart& part, const std::string& colormap) {
    const CurvatureSubject& s = c.subject;
    SixViewFigure figure{.id = "q1_tangential",
                         .title = words.line("tangential.title"),
                         .subtitle = subtitle_of(*s.source),
                         .caption = words.line("tangential.caption", "mesh"_a = s.name(), "undefined"_a = undefined_words(s)),
                         .panels = {panel_of(*s.source, "q1_" + s.name() + "_tangential", s.name(), 100 * part.shares)},
                         .turnable = true};
    figure.range =
        output::ColorRange{.colormap = colormap, .low = 0, .high = 100, .quantity = words.line("tangential.quantity"), .unit = "%"};
    figure.range = range_for(*figure.range, figure.panels);
    add_figure(answer, std::move(figure));
}

}   // namespace meshfolio::q1_uniform
