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
    std::string words = figure.title + ", seen from +x, \u2212x, +y, \u2212y, +z and \u2212z: ";
    for (std::size_t i = 0; i < figure.panels.size(); ++i) words += (i > 0 ? "; " : "") + described(figure.panels[i]);
    if (figure.range) {
        words += ". Colours: " + figure.range->quantity + " from " + readable(figure.range->low) + " to " + readable(figure.range->high);
        if (!figure.range->unit.empty()) words += " " + figure.range->unit;
    }
    return words + ".";
}

}   // namespace

void add_figure(Answer& answer, SixViewFigure figure) {
    answer.section.blocks.push_back(report::Figure{figure.id, figure.caption, alternative_text(figure)});
    answer.figures.push_back({std::move(figure.id), std::move(figure.title), std::move(figure.subtitle), std::move(figure.panels),
                              std::move(figure.range), figure.edges, figure.frame_panel});
    answer.figures.back().turnable = figure.turnable;
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
