// Names, titles and texts are data: whatever bytes they hold, the files keep their structure. The templates are short ones of the same view
// model: the whole ones take ten times as long and put the same words into the same kinds of places.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "fuzz/fuzz_input.h"
#include "report/writers.h"

namespace {

using namespace meshfolio;

report::Document document_with(const std::string& words) {
    report::Section section;
    section.id = "q1";
    section.title = section.asked = section.extent = words;
    section.inputs = {{.role = words, .asked = words, .file = words, .stand_in = false, .sha256 = "", .vertices = 3, .triangles = 1}};
    section.parameters = {{words, words}};
    section.warnings = {words};
    section.blocks.push_back(report::Heading{words});
    section.blocks.push_back(report::Paragraph{report::text(words, report::strong(words), report::code(words), report::math(words))});
    report::Table table{.id = "q1_table", .caption = words, .columns = {{.name = words, .unit = words}}, .rows = {{words}, {1.5}}};
    section.blocks.push_back(table);
    report::Document document;
    document.title = document.author = document.course = words;
    document.sections = {section};
    return document;
}

/// Opening, closing and empty elements balance: what an XML parser asks of a page first.
void require_balanced(std::string_view page) {
    long depth = 0;
    for (std::size_t at = page.find('<'); at != std::string_view::npos; at = page.find('<', at + 1)) {
        if (page.substr(at).starts_with("<!--")) fuzzing::require(false, "a page has no comment");
        if (page.substr(at).starts_with("<!")) continue;
        const std::size_t end = page.find('>', at);
        fuzzing::require(end != std::string_view::npos, "every tag ends");
        if (page.substr(at).starts_with("</")) {
            --depth;
        } else if (page[end - 1] != '/') {
            ++depth;
        }
        fuzzing::require(depth >= 0, "nothing closes that is not open");
        at = end;
    }
    fuzzing::require(depth == 0, "everything that opens closes");
}

/// What lies outside of style sheets and scripts, in which '<' means "less".
std::string markup_of(std::string page) {
    for (const std::string name : {"style", "script"}) {
        for (std::size_t from = page.find("<" + name); from != std::string::npos; from = page.find("<" + name)) {
            const std::string close = "</" + name + ">";
            page.erase(from, page.find(close, from) + close.size() - from);
        }
    }
    return page;
}

constexpr const char* short_page = R"(<html lang="en">
<h1>{{title}}</h1><p title="{{author}}">{{course}}</p>
{{#sections}}<section id="{{id}}">
<h2>{{title}}</h2>{{#asked}}{{>text.html}}{{/asked}}{{#warnings}}<li>{{text}}</li>{{/warnings}}
{{#inputs}}<td>{{role}}</td><td><code>{{asked}}</code></td><td title="{{file}}">{{file}}</td>{{/inputs}}
{{#parameters}}<dt>{{#name}}{{>text.html}}{{/name}}</dt><dd>{{#value}}{{>text.html}}{{/value}}</dd>{{/parameters}}
{{#blocks}}{{#is_heading}}<h3 id="{{anchor}}">{{#title}}{{>text.html}}{{/title}}</h3>{{/is_heading}}
{{#is_paragraph}}<p>{{>text.html}}</p>{{/is_paragraph}}
{{#is_table}}<table id="{{id}}"><caption>{{#caption}}{{>text.html}}{{/caption}}</caption>
{{#columns}}<th>{{#name}}{{>text.html}}{{/name}}{{#has_unit}}{{unit}}{{/has_unit}}</th>{{/columns}}
{{#rows}}{{#cells}}<td>{{#is_words}}{{>text.html}}{{/is_words}}{{^is_words}}{{number}}{{/is_words}}</td>{{/cells}}{{/rows}}
</table>{{/is_table}}{{/blocks}}</section>{{/sections}}
</html>
)";

constexpr const char* short_markdown = R"(# {{title}}

{{author}}
{{#sections}}
## {{number}} {{title}}

> {{#asked}}{{>text.md}}{{/asked}}
{{#blocks}}{{#is_heading}}### {{#title}}{{>text.md}}{{/title}}{{/is_heading}}{{#is_paragraph}}- {{>text.md}}{{/is_paragraph}}{{#is_table}}
{{#columns}}| {{#name}}{{>text.md}}{{/name}} [{{unit}}] |{{/columns}}{{/is_table}}
{{/blocks}}{{/sections}}
)";

/// Markdown in which only the template makes elements, cells and lines.
void require_no_new_structure(const std::string& page) {
    require_balanced(page);
    long bars = 0;
    bool escaped = false;
    for (const char c : page) {
        bars += c == '|' && !escaped ? 1 : 0;
        escaped = c == '\\' && !escaped;
    }
    fuzzing::require(bars == 2, "a word makes no cell of a table");
    static const auto lines = std::count(page.begin(), page.end(), '\n');
    fuzzing::require(std::count(page.begin(), page.end(), '\n') == lines, "a word makes no line");
}

report::Templates short_templates() {
    report::Templates templates;
    templates.set("report.html", short_page, "short_page");
    templates.set("report.md", short_markdown, "short_markdown");
    templates.set("formulas.json", "{}", "no formulas");
    templates.set("references.json", "[]", "no references");
    return templates;
}

}   // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    if (size > 4096) return 0;
    static const report::Templates templates = short_templates();
    const std::string_view words = fuzzing::text_of(bytes, size);
    const report::Document document = document_with(std::string(words));
    // One of the three by the last byte: they take their time, and share the view model.
    switch (words.empty() ? 0 : static_cast<unsigned char>(words.back()) % 3) {
        case 0:
            require_balanced(markup_of(report::write_html(document, {}, templates)));
            break;
        case 1:
            require_no_new_structure(report::write_markdown(document, {}, templates));
            break;
        default:
            fuzzing::require(nlohmann::json::accept(report::write_json(document, {})), "results.json is JSON");
    }
    return 0;
}
