#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// A quantity that every mesh shows on a range of its own, for values of meshes are not compared.
struct Shown {
    std::string key;   // the end of its figure's name
    const char *title, *caption, *quantity, *label, *zero;
    double floor;   // of the range
    double least;   // below it all is 0 but for rounding
    Vector (*values)(const MeshCurvature&);
};

const Shown shown[]{
    {"h", "h.title", "h.caption", "h.quantity", "h.label", "h.label.zero", 0.1, 100 * visible,
     [](const MeshCurvature& c) -> Vector { return 100 / c.subject.mean_edge * c.length; }},
    {"k", "k.title", "k.caption", "k.quantity", "k.label", "k.label.zero", 0.1, 0.01,
     [](const MeshCurvature& c) -> Vector { return c.subject.diagonal * c.subject.diagonal * c.K; }},
};

/// In percent of the mesh's own range, which its label tells.
output::Panel panel_of(const Shown& quantity, const MeshCurvature& c) {
    const std::string& name = c.subject.name();
    output::Panel panel;
    panel.values = quantity.values(c);
    const double range = output::robust_range({panel}, "diverging", "", "", quantity.floor).high;
    const double most = largest_magnitude(panel.values);
    const std::string label =
        words.line(most > quantity.least ? quantity.label : quantity.zero, "mesh"_a = name, "most"_a = readable(most, 2),
                   "range"_a = readable(range, 2), "beyond"_a = beyond_words(panel.values, range));
    return relative_panel(c.subject, "q1_" + name + "_" + quantity.key, label, panel.values, range);
}

/// Rings the irregular vertices that the text speaks of. @return a space and a sentence that names these meshes, or nothing
std::string mark_irregular_vertices(std::vector<output::Panel>& panels, const Meshes& meshes) {
    Names ringed;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const IrregularVertices odd = irregular_vertices(meshes[i]);
        if (!odd.ringed()) continue;
        panels[i].marked_vertices = odd.vertices;
        ringed.push_back(meshes[i].subject.name());
    }
    if (ringed.empty()) return {};
    return " " + words.line(ringed.size() == meshes.size() ? "k.marked.all" : "k.marked", "meshes"_a = listed(ringed));
}

}   // namespace

void add_figures(Answer& answer, const Meshes& meshes) {
    UndefinedVertices masked;
    for (const MeshCurvature& c : meshes) masked += undefined_vertices(c.subject);
    for (const Shown& quantity : shown) {
        output::FigureRequest figure{.id = "q1_" + quantity.key,
                                     .title = words.line(quantity.title),
                                     .range = relative_range(words.line(quantity.quantity)),
                                     .frame_panel = -1,
                                     .turnable = quantity.key == "h",
                                     .view_files = true};
        for (const MeshCurvature& c : meshes) figure.panels.push_back(panel_of(quantity, c));
        const std::string marked = quantity.key == "k" ? mark_irregular_vertices(figure.panels, meshes) : "";
        add_figure(answer, std::move(figure), words.line(quantity.caption) + marked + undefined_words(masked));
    }
}

void add_tangential_figure(Answer& answer, const Meshes& meshes, const std::string& colormap) {
    output::FigureRequest figure{.id = "q1_tangential",
                                 .title = words.line("tangential.title"),
                                 .frame_panel = -1,
                                 .layout = output::Layout::multiples,
                                 .turnable = true};
    UndefinedVertices masked;
    for (const MeshCurvature& c : meshes) {
        if (c.subject.plane_normal || summary_of(c.H).count == 0) continue;
        const TangentialPart part = tangential_part(c);
        const std::string label = words.line("tangential.label", "mesh"_a = c.subject.name(), "share"_a = readable_percent(part.share, 2));
        figure.panels.push_back(relative_panel(c.subject, "q1_" + c.subject.name() + "_tangential", label, part.shares, 1));
        masked += undefined_vertices(c.subject);
    }
    figure.range =
        range_for({.colormap = colormap, .low = 0, .high = 100, .quantity = words.line("tangential.quantity"), .unit = "%"}, figure.panels);
    add_figure(answer, std::move(figure), words.line("tangential.caption", "undefined"_a = undefined_words(masked)));
}

}   // namespace meshfolio::q1_uniform
