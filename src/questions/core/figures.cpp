#include "mesh/triangle_measures.h"
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

std::string alternative_text(const output::FigureRequest& figure) {
    constexpr report::Words words("figures");
    Names panels;
    for (const output::Panel& panel : figure.panels) panels.push_back(described(panel));
    report::Facts facts{"title"_a = figure.title,
                        "seen"_a = words.line(figure.layout == output::Layout::six_views ? "seen.six" : "seen.one"),
                        "panels"_a = joined(panels)};
    if (!figure.range) return words.line("alt", facts);
    const std::string unit = figure.range->unit.empty() ? "" : " " + figure.range->unit;
    facts.insert(facts.end(), {"quantity"_a = figure.range->quantity, "low"_a = readable(figure.range->low),
                               "high"_a = readable(figure.range->high) + unit});
    return words.line("alt.coloured", facts);
}

}   // namespace

void add_figure(Answer& answer, output::FigureRequest request, std::string caption) {
    std::string alt = alternative_text(request);
    add_figure(answer, std::move(request), std::move(caption), std::move(alt));
}

void add_figure(Answer& answer, output::FigureRequest request, std::string caption, std::string alt) {
    add(answer.section, report::Figure{request.id, std::move(caption), std::move(alt)});
    answer.figures.push_back(std::move(request));
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

TriangleMesh in_unit_box(const TriangleMesh& mesh, const Positions& X) {
    const Box box = bounding_box(mesh);
    return moved_to(mesh, (X.rowwise() - box.centre().transpose()) / box.diagonal());
}

}   // namespace meshfolio
