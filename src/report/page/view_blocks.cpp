#include "report/page/view_blocks.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "report/escape.h"
#include "report/page/math_markup.h"
#include "report/page/mathml.h"
#include "report/page/page_design.h"
#include "report/page/view_value.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

constexpr const char* runs_meaning = "a text, piece by piece";
constexpr const char* number_meaning = "of a heading \"4.2\", of an equation \"(4.1)\"";

json run_view(const Run& run, const Reference& target) {
    const bool is_reference = run.kind == Run::Kind::reference, is_math = run.kind == Run::Kind::math;
    const bool is_link = is_reference && !target.anchor.empty() && (!target.elsewhere || !target.page.empty());
    json parts = list_of(is_math ? math_parts(safe_text(run.content)) : std::vector<MathPart>(), [](const MathPart& part) {
        return view_of({{"text", "its letters", part.text},
                        {"is_upright", "operators, digits, names", part.kind == MathPart::Kind::upright},
                        {"is_variable", "italic in print", part.kind == MathPart::Kind::variable},
                        {"is_vector", "bold in print", part.kind == MathPart::Kind::vector},
                        {"is_subscript", "lowered", part.kind == MathPart::Kind::subscript},
                        {"is_superscript", "raised", part.kind == MathPart::Kind::superscript}});
    });
    return view_of({{"text", "words of the piece", safe_text(is_reference ? target.label : run.content)},
                    {"href", "where a link leads, in this page or that of the other volume", target.page + "#" + url_path(target.anchor)},
                    {"mathml", "mathematics for browsers", is_math ? inline_mathml(safe_text(run.content)) : ""},
                    {"lead", "punctuation before mathematics, which mathml includes", ""},
                    {"tail", "punctuation behind mathematics, which mathml includes", ""},
                    {"parts", "pieces of mathematics; empty in other pieces", std::move(parts)},
                    {"is_plain", "words as they are", run.kind == Run::Kind::plain || (is_reference && !is_link)},
                    {"is_strong", "bold", run.kind == Run::Kind::strong},
                    {"is_emphasis", "italic", run.kind == Run::Kind::emphasis},
                    {"is_code", "a name from the program", run.kind == Run::Kind::code},
                    {"is_math", "mathematics: print mathml, or the parts", is_math},
                    {"is_link", "a link to `href`", is_link},
                    {"is_elsewhere", "what it names is in the other volume, and no page can be linked to (print.html only)",
                     is_reference && !is_link && target.elsewhere}});
}

/// Returns the runs with the punctuation beside each formula moved into its view, as browsers break lines between <math> and its
/// neighbours.
json kept_at_formulas(json runs) {
    const auto take = [](json& run, bool last, const std::string& marks) {
        std::string text = run["text"];
        if (!run["is_plain"] || text.empty() || marks.find(last ? text.back() : text.front()) == std::string::npos) return std::string();
        const std::string mark(1, last ? text.back() : text.front());
        text.erase(last ? text.size() - 1 : 0, 1);
        run["text"] = text;
        return mark;
    };
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (!runs[i]["is_math"]) continue;
        const std::string lead = i > 0 ? take(runs[i - 1], true, "([") : "";
        std::string tail;
        for (std::string mark; i + 1 < runs.size() && !(mark = take(runs[i + 1], false, ",.;:!?)]")).empty();) tail += mark;
        if ((lead + tail).empty()) continue;
        const std::string open = "<span class=\"kept\">", close = "</span>", mathml = runs[i]["mathml"];
        const std::size_t first = std::min(mathml.find("<wbr/>"), mathml.size()), at = mathml.rfind("<wbr/>");
        const std::size_t last = at == std::string::npos ? 0 : at + 6;
        runs[i]["lead"] = lead;
        runs[i]["tail"] = tail;
        runs[i]["mathml"] = last == 0 ? open + lead + mathml + tail + close
                                      : open + lead + mathml.substr(0, first) + close + mathml.substr(first, last - first) + open +
                                            mathml.substr(last) + tail + close;
    }
    return runs;
}

json formula_view(const Formula& formula, const ViewContext& context) {
    const auto forms = context.formulas.find(formula.name);
    if (forms == context.formulas.end()) throw std::logic_error("report: formulas.json has no formula " + formula.name);
    const bool numbered = !formula.id.empty();
    return view_of({{"id", "anchor", safe_text(formula.id)},
                    {"is_numbered", "the equation has a number", numbered},
                    {"number", number_meaning, numbered ? context.numbering.resolve(formula.id).number : ""},
                    {"mathml", "the equation for browsers", forms->second.mathml},
                    {"tex", "for Markdown", forms->second.tex},
                    {"plain", "in words", forms->second.plain}});
}

/// Returns a plot, a map or a diagram. A diagram has no file of data.
template <class Drawing> json drawing_view(const Drawing& drawing, const ViewContext& context) {
    json view = captioned_view(drawing.id, drawing.caption, context), markers = json::array();
    std::string column;
    if constexpr (std::is_same_v<Drawing, Plot>) {
        if (context.options.columns) column = column_svg_of(drawing);
        const auto add = [&](const std::string& label) {
            if (!label.empty()) markers.push_back(view_of({{"text", "its label", safe_text(label)}}));
        };
        for (const Marker& marker : drawing.markers) add(marker.label);
        for (const auto& line : drawing.vertical_lines) add(line.label);
        enter_separators(markers);
    }
    const bool is_slim = !column.empty();
    enter(view, {{"is_slim", "it is drawn for a column of a paper (print.html only)", is_slim},
                 {"alt", "the picture in words", safe_text(drawing.alt)},
                 {"has_csv", "its data are a file", !std::is_same_v<Drawing, Diagram>},
                 {"csv", "link to the data", url_path("tables/" + drawing.id + ".csv")},
                 {"svg", "the drawing, inside the page",
                  is_slim                    ? column
                  : context.options.pictures ? svg_of(drawing)
                                             : ""},
                 {"has_file", "there is that file", context.options.plot_files},
                 {"file", "the drawing as a file", url_path("images/" + drawing.id + ".svg")}});
    enter_list(view, "markers", "what is marked in a plot", std::move(markers));
    return view;
}

/// Returns a GLB model with zeros in place of normals and colours, which the viewer computes itself and which then compress to nothing.
/// Other bytes are returned unchanged.
std::string without_looks(const std::string& glb) {
    constexpr std::size_t json_at = 20, chunk_head = 8;
    std::string light = glb;
    try {
        std::uint32_t length = 0;
        glb.copy(reinterpret_cast<char*>(&length), sizeof length, json_at - chunk_head);
        const json head = json::parse(glb.substr(json_at, length));
        const json& attributes = head.at("meshes").at(0).at("primitives").at(0).at("attributes");
        for (const char* name : {"NORMAL", "COLOR_0"}) {
            if (!attributes.contains(name)) continue;
            const json& view = head.at("bufferViews")
                                   .at(head.at("accessors").at(attributes.at(name).get<std::size_t>()).at("bufferView").get<std::size_t>());
            const auto size = std::min(view.at("byteLength").get<std::size_t>(), glb.size());
            light.replace(json_at + length + chunk_head + view.at("byteOffset").get<std::size_t>(), size, size, '\0');
        }
    } catch (const std::exception&) {
        return glb;
    }
    return light;
}

json model_view(const DrawnModel& model, const ViewContext& context) {
    const std::string label = model.label.empty() ? "" : ", " + model.label;
    const std::string size = std::to_string((model.glb.size() + 999) / 1000);
    return view_of({{"label", "of its panel; empty where it is the only one", safe_text(model.label)},
                    {"name", "in words, with its size", safe_text("3D model" + label + " (GLB, " + size + " KB)")},
                    {"href", "link to the file", url_path(model.file)},
                    {"quantity", "of the values, with the unit", safe_text(model.quantity)},
                    {"data", "the file, zlib and base64, where the page can turn it",
                     context.options.models ? packed(without_looks(model.glb)) : ""}});
}

json figure_view(const Figure& figure, const ViewContext& context) {
    const auto it = context.figures.find(figure.id);
    const DrawnFigure drawn = it != context.figures.end() ? it->second : DrawnFigure{};
    json view = captioned_view(figure.id, figure.caption, context);
    enter_pictures(view, figure, drawn, context);
    json groups = json::array();
    std::size_t count = 0;
    for (const DrawnPanel& panel : drawn.panels) {
        json views = json::array();
        for (const DrawnPicture& picture : panel.pictures) {
            if (picture.file.empty()) continue;
            const std::string name = picture.view.empty() ? "three quarters" : picture.direction();
            views.push_back(view_of({{"name", "\"+x\"", safe_text(name)}, {"href", "link to the picture", url_path(picture.file)}}));
        }
        if (views.empty()) continue;
        count += views.size();
        const bool has_name = drawn.panels.size() > 1 && !panel.label.empty();
        groups.push_back(view_of({{"panel", "name of the panel", safe_text(panel.label)},
                                  {"has_panel", "it has one", has_name},
                                  {"views", "of the panel", std::move(views)}}));
    }
    enter(view, {{"has_views", "the single pictures are linked", context.options.single_views && count > 0},
                 {"view_count", "how many", std::to_string(count)},
                 {"groups", "single pictures, a group a panel", std::move(groups)},
                 {"is_turnable", "the page itself can turn its models", context.options.models && !drawn.models.empty()}});
    enter_list(view, "models", "meshes of the figure as files",
               list_of(drawn.models, [&](const DrawnModel& model) { return model_view(model, context); }));
    return view;
}

/// Returns the text without parentheses that refer to a section which the report does not show, such as " ([[q4]])".
Text without_hidden(Text text, const Numbering& numbering) {
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        if (text[i].kind != Run::Kind::reference || numbering.resolve(text[i].content).is_shown) continue;
        std::string &before = text[i - 1].content, &after = text[i + 1].content;
        const std::size_t open = before.rfind(" ("), close = after.find(')');
        const bool encloses = open != std::string::npos && before.find(')', open) == std::string::npos && close < after.find('(');
        if (!encloses) continue;
        before = before.substr(0, open) + after.substr(close + 1);
        text.erase(text.begin() + static_cast<std::ptrdiff_t>(i), text.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    }
    return text;
}

}   // namespace

void enter_separators(json& list) {
    for (std::size_t i = 0; i < list.size(); ++i)
        enter(list[i], {{"separator", "a semicolon and a blank, but after the last", i + 1 < list.size() ? "; " : ""}});
}

json text_view(const Text& text, const Numbering& numbering) {
    json runs = json::array();
    for (const Run& run : without_hidden(text, numbering)) {
        if (run.kind == Run::Kind::plain) {
            for (const Run& part : prose(run.content)) runs.push_back(run_view(part, {}));
        } else {
            runs.push_back(run_view(run, run.kind == Run::Kind::reference ? numbering.resolve(run.content) : Reference{}));
        }
    }
    return view_of({{"runs", runs_meaning, kept_at_formulas(std::move(runs))}});
}

json prose_view(const std::string& words) {
    return view_of({{"runs", runs_meaning, kept_at_formulas(list_of(prose(words), [](const Run& run) { return run_view(run, {}); }))}});
}

json letters_view(const std::string& words) {
    json view = prose_view(words);
    enter(view, {{"has_mathml", "false: outlines, contents and heads of tables know letters alone", false}});
    return view;
}

json captioned_view(const std::string& id, const std::string& caption, const ViewContext& context) {
    return view_of({{"id", "anchor", safe_text(id)},
                    {"label", "\"Table 4.1\", \"Figure 4.2\"", context.numbering.resolve(id).label},
                    {"caption", "what to see", prose_view(caption)}});
}

json block_view(const Block& block, const std::string& section_number, int& headings, const ViewContext& context) {
    json view = json::object();
    const auto text = [&](const Text& words) { return text_view(words, context.numbering); };
    if (const auto* heading = std::get_if<Heading>(&block)) {
        const std::string number = section_number + "." + std::to_string(++headings);
        view = view_of({{"title", "of a heading", letters_view(heading->title)},
                        {"number", number_meaning, number},
                        {"anchor", "of a heading", "section-" + number}});
    } else if (const auto* paragraph = std::get_if<Paragraph>(&block)) {
        view = text(paragraph->text);
    } else if (const auto* list = std::get_if<BulletList>(&block)) {
        view = view_of({{"items", "of bullets", list_of(list->items, text)}});
    } else if (const auto* formula = std::get_if<Formula>(&block)) {
        view = formula_view(*formula, context);
    } else if (const auto* table = std::get_if<Table>(&block)) {
        view = table_view(*table, context);
    } else if (const auto* plot = std::get_if<Plot>(&block)) {
        view = drawing_view(*plot, context);
    } else if (const auto* map = std::get_if<Map>(&block)) {
        view = drawing_view(*map, context);
    } else if (const auto* diagram = std::get_if<Diagram>(&block)) {
        view = drawing_view(*diagram, context);
    } else if (const auto* figure = std::get_if<Figure>(&block)) {
        view = figure_view(*figure, context);
    }
    const bool is_plot =
        std::holds_alternative<Plot>(block) || std::holds_alternative<Map>(block) || std::holds_alternative<Diagram>(block);
    enter(view, {{"is_heading", "heading: title, number, anchor", std::holds_alternative<Heading>(block)},
                 {"is_paragraph", "paragraph: runs", std::holds_alternative<Paragraph>(block)},
                 {"is_list", "bullets: items", std::holds_alternative<BulletList>(block)},
                 {"is_formula", "displayed equation: mathml, tex, plain", std::holds_alternative<Formula>(block)},
                 {"is_table", "table: columns, rows", std::holds_alternative<Table>(block)},
                 {"is_plot", "plot, map or diagram: svg", is_plot},
                 {"is_figure", "pictures of meshes: source, groups", std::holds_alternative<Figure>(block)}});
    return view;
}

}   // namespace meshfolio::report
