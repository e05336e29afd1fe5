#include "report/writers.h"

#include <algorithm>

#include "report/batch/batch.h"
#include "report/bibliography.h"
#include "report/page/page_design.h"
#include "report/page/view_model.h"
#include "report/page/view_value.h"
#include "report/words.h"

namespace meshfolio::report {

namespace {

constexpr std::size_t rows_shown = 2;

/// Returns a document with one of each part that a template can print.
Document specimen(const Templates& templates) {
    Section section;
    section.id = "q0";
    section.inputs.emplace_back();
    section.parameters = {{"", ""}};
    section.code.emplace_back();
    section.checks.emplace_back();
    section.answer = {math("x"), ref(bibliography_of(templates).front().id)};
    section.warnings = section.output_meshes = {""};
    const Table table{.id = "table", .columns = {{}}, .rows = std::vector<std::vector<Cell>>(rows_shown + 1, {Cell()})};
    section.blocks = {Heading(),
                      Paragraph(),
                      BulletList{{{}}},
                      Formula{formulas_of(templates).begin()->first, ""},
                      table,
                      Plot{.id = "plot", .markers = {{.label = "marker"}}},
                      Figure{"figure", "", ""},
                      Figure{"matrix", "", ""}};
    Document document;
    document.provenance.libraries = document.provenance.settings = {{"", ""}};
    document.sections = {section};
    document.timings.emplace_back();
    return document;
}

/// Collects the meanings of all tags by their paths. Texts are alike everywhere: paths inside them begin with their last "runs".
void collect(const nlohmann::json& value, const std::string& path, std::map<std::string, std::string>& tags) {
    if (value.is_array()) {
        for (const auto& item : value) collect(item, path, tags);
    } else if (value.is_object()) {
        for (const auto& [tag, meaning] : value.at(KeptMeanings::key).items()) {
            const std::string inner = path.empty() ? tag : path + "." + tag;
            const std::size_t runs = (inner + ".").rfind(".runs.");
            tags[runs == std::string::npos ? inner : inner.substr(runs + 1)] = meaning;
            collect(value.at(tag), inner, tags);
        }
    }
}

}   // namespace

std::map<std::string, std::string> tag_list() {
    const KeptMeanings kept;
    const Templates templates;
    DrawnFigure drawn;
    drawn.panels = {{.label = "", .pictures = {{.view = ""}, {.view = "+x", .file = "x.png"}}}};
    DrawnFigure matrix;
    matrix.columns = matrix.rows = {""};
    matrix.panels = {{.label = "", .pictures = {{}}}};
    drawn.models.emplace_back();
    drawn.legend.emplace();
    nlohmann::json model = view_model(specimen(templates), {{"figure", drawn}, {"matrix", matrix}}, templates,
                                      {.lab_questions = "q0 ", .table_rows = rows_shown});
    add_design(model, templates, "report", {true, "viewer", {{"q0", "data"}}});
    BatchRow row;
    row.defects = {{"", 0}};
    enter(model, {{"batch", "meshes with a report each (batch.html only)", batch_view({{row}})},
                  {"version", "of the program (batch.html only)", ""}});
    std::map<std::string, std::string> tags;
    collect(model, "", tags);
    return tags;
}

std::string tag_documentation() {
    std::string text =
        "Tags of the templates (Mustache), by their place in the view model: inside {{#sections}}{{#blocks}} … the tag "
        "sections.blocks.caption\n"
        "is {{caption}}, and outer names are known inside as well. Tags is_… and has_… are true or false. Captions, titles, names and\n"
        "the like have `runs`: {{#caption}}{{>text.html}}{{/caption}} prints them. {{tag}} is escaped; {{{tag}}} is for mathml, "
        "svg,\n"
        "style and script alone.\n\n";
    const auto tags = tag_list();
    std::size_t width = 0;
    for (const auto& [tag, meaning] : tags) width = std::max(width, tag.size());
    for (const auto& [tag, meaning] : tags) text += tag + std::string(width + 2 - tag.size(), ' ') + meaning + "\n";
    return text + "\n" + words_documentation();
}

}   // namespace meshfolio::report
