#include "questions/core/six_view_figure.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// A quantity that all meshes show on one colour range.
struct Shown {
    std::string key;   // the end of its figures' names
    const char *title, *caption, *unit;
    Vector (*values)(const MeshCurvature&);
};

const Shown shown[]{
    {"h", "h.title", "h.caption", "% of mean edge", [](const MeshCurvature& c) -> Vector { return 100 / c.subject.mean_edge * c.length; }},
    {"k", "k.title", "k.caption", "", [](const MeshCurvature& c) -> Vector { return c.subject.diagonal * c.subject.diagonal * c.K; }},
};

}   // namespace

void add_figures(Answer& answer, const Meshes& meshes) {
    const std::string shared = meshes.size() > 1 ? " " + words.line("shared_range") : "";
    for (const Shown& quantity : shown) {
        std::vector<output::Panel> panels;
        for (const MeshCurvature& c : meshes) {
            const std::string& name = c.subject.name();
            panels.push_back(panel_of(*c.subject.source, "q1_" + name + "_" + quantity.key, name, quantity.values(c)));
        }
        const std::string title = words.line(quantity.title);
        const auto range = output::robust_range(equally_weighted(panels), "diverging", title, quantity.unit, 0.1);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const CurvatureSubject& s = meshes[i].subject;
            add_figure(answer, {.id = panels[i].name,
                                .title = title,
                                .subtitle = subtitle_of(*s.source),
                                .caption = words.line(quantity.caption, "mesh"_a = s.name(), "shared"_a = shared,
                                                      "undefined"_a = undefined_words(s)),
                                .panels = {panels[i]},
                                .range = range_for(range, {panels[i]}),
                                .turnable = quantity.key == "h"});
        }
    }
}

}   // namespace meshfolio::q1_uniform
