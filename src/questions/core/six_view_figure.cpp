#include "questions/core/six_view_figure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

namespace {

std::string described(const output::Panel& panel) {
    std::string words = panel.label;   // empty where the title says all; names are for files alone
    double low = INFINITY, high = -INFINITY;
    for (const double v : panel.values) {
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    const std::string range = low <= high ? "values from " + readable(low) + " to " + readable(high) : words.empty() ? "no values" : "";
    if (!range.empty()) words += (words.empty() ? "" : ", ") + range;
    return words;
}

std::string alternative_text(const SixViewFigure& figure) {
    constexpr report::Words words("figures");
    std::string panels;
    for (const output::Panel& panel : figure.panels) panels += (panels.empty() ? "" : "; ") + described(panel);
    const std::string seen = words.line(figure.layout == output::Layout::six_views ? "seen.six" : "seen.one");
    if (!figure.range) return words.line("alt", "title"_a = figure.title, "seen"_a = seen, "panels"_a = panels);
    const std::string unit = figure.range->unit.empty() ? "" : " " + figure.range->unit;
    return words.line("alt.coloured", "title"_a = figure.title, "seen"_a = seen, "panels"_a = panels, "quantity"_a = figure.range->quantity,
                      "low"_a = readable(figure.range->low), "high"_a = readable(figure.range->high) + unit);
}

}   // namespace

void add_figure(Answer& answer, SixViewFigure figure) {
    answer.section.blocks.push_back(report::Figure{figure.id, figure.caption, alternative_text(figure)});
    answer.figures.push_back({std::move(figure.id), std::move(figure.title), std::move(figure.subtitle), std::move(figure.panels),
                              std::move(figure.range), figure.edges, figure.frame_panel});
    answer.figures.back().coarse_edges = figure.coarse_edges;
    answer.figures.back().states = figure.states;
    answer.figures.back().turnable = figure.turnable;
    answer.figures.back().view_files = figure.view_files;
    answer.figures.back().layout = figure.layout;
}

std::string subtitle_of(const LibraryMesh& mesh) {
    return mesh.input.file + ", " + counted(mesh.mesh().vertex_count(), "vertex", "vertices");
}

output::Panel panel_of(const LibraryMesh& mesh, std::string name, std::string label, Vector values) {
    // Shares ownership of the prepared mesh, so nothing is copied.
    return {std::move(name), std::move(label), std::shared_ptr<const TriangleMesh>(mesh.prepared, &mesh.prepared->mesh), std::move(values)};
}

output::Panel panel_of(TriangleMesh mesh, std::string name, std::string label, Vector values) {
    return {std::move(name), std::move(label), std::make_shared<const TriangleMesh>(std::move(mesh)), std::move(values)};
}

}   // namespace meshfolio
