#include "report/page/view_blocks.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "report/escape.h"
#include "report/page/math_markup.h"
#include "report/page/page_viewer.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

json math_view(const std::string& math) {
    json parts = json::array();
    for (const MathPart& part : math_parts(safe_text(math))) {
        parts.push_back({{"text", part.text},
                         {"is_upright", part.kind == MathPart::Kind::upright},
                         {"is_variable", part.kind == MathPart::Kind::variable},
                         {"is_subscript", part.kind == MathPart::Kind::subscript},
                         {"is_superscript", part.kind == MathPart::Kind::superscript}});
    }
    return parts;
}

json run_view(const Run& run, const Reference& target) {
    const bool is_reference = run.kind == Run::Kind::reference;
    return {{"text", safe_text(is_reference ? target.label : run.content)},
            {"href", "#" + url_path(target.anchor)},
            {"parts", run.kind == Run::Kind::math ? math_view(run.content) : json::array()},
            {"is_plain", run.kind == Run::Kind::plain || (is_reference && target.anchor.empty())},
            {"is_strong", run.kind == Run::Kind::strong},
            {"is_emphasis", run.kind == Run::Kind::emphasis},
            {"is_code", run.kind == Run::Kind::code},
            {"is_math", run.kind == Run::Kind::math},
            {"is_link", is_reference && !target.anchor.empty()},
            {"is_elsewhere", is_reference && target.left_out}};
}

json formula_view(const Formula& formula, const ViewContext& context) {
    const auto forms = context.formulas.find(formula.name);
    if (forms == context.formulas.end()) throw std::logic_error("report: formulas.json has no formula " + formula.name);
    const bool numbered = !formula.id.empty();
    const std::string number = numbered ? context.numbering.resolve(formula.id).number : "";
    return {{"id", safe_text(formula.id)},
            {"is_numbered", numbered},
            {"number", number},
            {"mathml", forms->second.mathml},
            {"tex", forms->second.tex},
            {"plain", forms->second.plain},
            {"has_mathml", !context.options.plain_formulas}};
}

/// What plots and maps have in common.
template <class Drawing>
json drawing_view(const Drawing& drawing, const ViewContext& context) {
    return {{"id", safe_text(drawing.id)},
            {"label", context.numbering.resolve(drawing.id).label},
            {"caption", prose_view(drawing.caption)},
            {"alt", safe_text(drawing.alt)},
            {"x_label", safe_text(drawing.x_label)},
            {"y_label", safe_text(drawing.y_label)},
            {"csv", url_path("tables/" + drawing.id + ".csv")},
            {"svg", context.options.pictures ? svg_of(drawing) : ""},
            {"has_file", context.options.plot_files},
            {"file", url_path("images/" + drawing.id + ".svg")},
            {"has_markers", false},
            {"markers", json::array()}};
}

json plot_view(const Plot& plot, const ViewContext& context) {
    json markers = json::array();
    for (const Marker& marker : plot.markers) {
        if (!marker.label.empty()) markers.push_back({{"text", safe_text(marker.label)}});
    }
    for (const auto& line : plot.vertical_lines) {
        if (!line.label.empty()) markers.push_back({{"text", safe_text(line.label)}});
    }
    json view = drawing_view(plot, context);
    for (std::size_t i = 0; i < markers.size(); ++i) markers[i]["separator"] = i + 1 < markers.size() ? "; " : "";
    view["has_markers"] = !markers.empty();
    view["markers"] = std::move(markers);
    return view;
}

/// Links to the single pictures, those of one panel together: "λ = 0.1, +x" belongs to the panel "λ = 0.1".
json view_groups(const DrawnFigure& drawn) {
    json groups = json::array();
    for (const auto& [label, file] : drawn.views) {
        const std::size_t comma = label.rfind(", ");
        const std::string panel = safe_text(comma == std::string::npos ? "" : label.substr(0, comma));
        const std::string name = safe_text(comma == std::string::npos ? label : label.substr(comma + 2));
        if (groups.empty() || groups.back()["panel"] != panel) {
            groups.push_back({{"panel", panel}, {"has_panel", !panel.empty()}, {"views", json::array()}});
        }
        groups.back()["views"].push_back({{"name", name}, {"href", url_path(file)}});
    }
    return groups;
}

/// "3D model, after (GLB, 23 KB)".
std::string name_of(const DrawnModel& model) {
    const std::string label = model.label.empty() ? "" : ", " + model.label;
    return safe_text("3D model" + label + " (GLB, " + std::to_string((model.glb.size() + 999) / 1000) + " KB)");
}

/// For templates/models.html: what each is called and where its file lies, and its bytes, packed, where the page can turn it.
json models_view(const DrawnFigure& drawn, const ViewContext& context) {
    json models = json::array();
    for (const DrawnModel& model : drawn.models) {
        models.push_back({{"label", safe_text(model.label)},
                          {"name", name_of(model)},
                          {"href", url_path(model.file)},
                          {"quantity", safe_text(model.quantity)},
                          {"has_quantity", !model.quantity.empty()},
                          {"data", context.options.models ? packed(model.glb) : ""}});
    }
    return models;
}

std::string image_source(const std::string& file, const std::string& jpeg, const ViewContext& context) {
    const bool inside = context.options.pictures && !jpeg.empty();
    return inside ? "data:image/jpeg;base64," + base64(jpeg) : url_path(file);
}

/// Before, after and their difference.
json comparison_view(const Figure& figure, const DrawnFigure& drawn, const ViewContext& context) {
    json panels = json::array();
    const std::string name = context.numbering.resolve(figure.id).label;
    for (const DrawnPanel& panel : drawn.comparison) {
        panels.push_back({{"label", prose_view(panel.label)},
                          {"alt", name + ": " + safe_text(panel.label)},
                          {"href", url_path(panel.file)},
                          {"source", image_source(panel.file, panel.preview_jpeg, context)},
                          {"has_size", panel.width > 0 && panel.height > 0},
                          {"width", std::to_string(panel.width)},
                          {"height", std::to_string(panel.height)}});
    }
    return panels;
}

json figure_view(const Figure& figure, const ViewContext& context) {
    const auto it = context.figures.find(figure.id);
    const DrawnFigure drawn = it != context.figures.end() ? it->second : DrawnFigure{};
    json view = picture_view(figure, context);
    view["id"] = safe_text(figure.id);
    view["label"] = context.numbering.resolve(figure.id).label;
    view["caption"] = prose_view(figure.caption);
    view["has_views"] = context.options.single_views && !drawn.views.empty();
    view["view_count"] = std::to_string(drawn.views.size());
    view["groups"] = view_groups(drawn);
    view["has_models"] = !drawn.models.empty();
    view["is_turnable"] = context.options.models && !drawn.models.empty();
    view["models"] = models_view(drawn, context);
    view["panels"] = comparison_view(figure, drawn, context);
    view["is_comparison"] = !drawn.comparison.empty();
    return view;
}

json entries_view(const EntryList& list, const ViewContext& context) {
    json entries = json::array();
    for (const Entry& entry : list.entries) {
        json paragraphs = json::array();
        for (const Text& paragraph : entry.paragraphs) paragraphs.push_back({{"runs", text_view(paragraph, context.numbering)}});
        entries.push_back({{"id", safe_text(entry.id)},
                           {"label", context.numbering.resolve(entry.id).label},
                           {"title", {{"runs", text_view(entry.title, context.numbering)}}},
                           {"paragraphs", std::move(paragraphs)}});
    }
    return {{"entries", std::move(entries)}};
}

}   // namespace

json text_view(const Text& text, const Numbering& numbering) {
    json runs = json::array();
    for (const Run& run : text) {
        if (run.kind == Run::Kind::plain) {
            for (const Run& part : prose(run.content)) runs.push_back(run_view(part, {}));
        } else {
            runs.push_back(run_view(run, run.kind == Run::Kind::reference ? numbering.resolve(run.content) : Reference{}));
        }
    }
    return runs;
}

json prose_view(const std::string& words) {
    json runs = json::array();
    for (const Run& run : prose(words)) runs.push_back(run_view(run, {}));
    return {{"runs", std::move(runs)}};
}

json picture_view(const Figure& figure, const ViewContext& context) {
    const auto it = context.figures.find(figure.id);
    const bool is_drawn = it != context.figures.end();
    const DrawnFigure drawn = is_drawn ? it->second : DrawnFigure{};
    const std::string sheet = url_path(drawn.sheet);
    return {
        {"alt", safe_text(figure.alt)},
        {"is_drawn", is_drawn},
        {"is_tall", 20 * drawn.height > 19 * drawn.width},
        {"is_wide", 2 * drawn.height < drawn.width},
        {"sheet", sheet},
        {"source", context.options.print_files ? url_path(print_file(figure.id)) : image_source(drawn.sheet, drawn.preview_jpeg, context)},
        {"has_size", drawn.width > 0 && drawn.height > 0},
        {"width", std::to_string(drawn.width)},
        {"height", std::to_string(drawn.height)}};
}

json block_view(const Block& block, const std::string& section_number, int& headings, const ViewContext& context) {
    json view = json::object();
    if (const auto* heading = std::get_if<Heading>(&block)) {
        const std::string number = section_number + "." + std::to_string(++headings);
        view = {{"title", prose_view(heading->title)}, {"number", number}, {"anchor", "section-" + number}};
    } else if (const auto* paragraph = std::get_if<Paragraph>(&block)) {
        view["runs"] = text_view(paragraph->text, context.numbering);
    } else if (const auto* list = std::get_if<BulletList>(&block)) {
        view["items"] = json::array();
        for (const Text& item : list->items) view["items"].push_back({{"runs", text_view(item, context.numbering)}});
    } else if (const auto* formula = std::get_if<Formula>(&block)) {
        view = formula_view(*formula, context);
    } else if (const auto* table = std::get_if<Table>(&block)) {
        view = table_view(*table, context);
    } else if (const auto* plot = std::get_if<Plot>(&block)) {
        view = plot_view(*plot, context);
    } else if (const auto* map = std::get_if<Map>(&block)) {
        view = drawing_view(*map, context);
    } else if (const auto* figure = std::get_if<Figure>(&block)) {
        view = figure_view(*figure, context);
    } else if (const auto* entries = std::get_if<EntryList>(&block)) {
        view = entries_view(*entries, context);
    }
    view["is_heading"] = std::holds_alternative<Heading>(block);
    view["is_paragraph"] = std::holds_alternative<Paragraph>(block);
    view["is_list"] = std::holds_alternative<BulletList>(block);
    view["is_formula"] = std::holds_alternative<Formula>(block);
    view["is_table"] = std::holds_alternative<Table>(block);
    view["is_plot"] = std::holds_alternative<Plot>(block) || std::holds_alternative<Map>(block);
    view["is_figure"] = std::holds_alternative<Figure>(block);
    view["is_entry_list"] = std::holds_alternative<EntryList>(block);
    return view;
}

}   // namespace meshfolio::report
