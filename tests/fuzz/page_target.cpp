// Names, titles and texts are data: whatever bytes they hold, the files keep their structure. The templates are short ones of the same view
// model: the whole ones take ten times as long and put the same words into the same kinds of places.
#include <array>
#include <nlohmann/json.hpp>

#include "fuzz/fuzz_input.h"
#include "report/writers.h"

namespace {

using namespace meshfolio;

/// Eight kinds of places, one of them filled: a document of all takes ten times as long, and no word meets another one.
report::Document document_with(const std::string& words, unsigned place) {
    report::Document document;
    report::Section section;
    section.id = "q1";
    switch (place % 8) {
        case 0: document.title = document.author = document.course = words; break;
        case 1: section.title = section.asked = section.extent = words; break;
        case 2:
            section.inputs = {
                {.role = words, .asked = words, .file = words, .stand_in = false, .sha256 = "", .vertices = 3, .triangles = 1}};
            break;
        case 3: section.parameters = {{words, words}}; break;
        case 4: section.warnings = {words}; break;
        case 5: section.blocks.push_back(report::Heading{words}); break;
        case 6:
            section.blocks.push_back(
                report::Paragraph{report::text(words, report::strong(words), report::code(words), report::math(words))});
            break;
        default:
            section.blocks.push_back(
                report::Table{.id = "q1_table", .caption = words, .columns = {{.name = words, .unit = words}}, .rows = {{words}, {1.5}}});
    }
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

/// Returns the page without style sheets and scripts, in which '<' means "less".
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
{{#inputs}}<td>{{name}}</td><td><code>{{asked}}</code></td><td title="{{file}}">{{file}}</td>{{/inputs}}
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

struct Structure {
    long cells = 0;
    long lines = 0;
    bool operator==(const Structure&) const = default;
};

/// Counts the characters that only the template may write in Markdown: bars between cells, and line ends.
Structure structure_of(const std::string& page) {
    Structure structure;
    bool escaped = false;
    for (const char c : page) {
        structure.cells += c == '|' && !escaped ? 1 : 0;
        structure.lines += c == '\n' ? 1 : 0;
        escaped = c == '\\' && !escaped;
    }
    return structure;
}

report::Templates short_templates() {
    report::Templates templates;
    templates.set("report.html", short_page, "short_page");
    templates.set("report.md", short_markdown, "short_markdown");
    templates.set("formulas.json", "{}", "no formulas");
    templates.set("references.json", "[]", "no references");
    return templates;
}

/// Returns the structure for each place that holds a word without characters to escape.
std::array<Structure, 8> plain_structures(const report::Templates& templates) {
    std::array<Structure, 8> structures;
    for (unsigned place = 0; place < structures.size(); ++place) {
        structures[place] = structure_of(report::write_markdown(document_with("word", place), {}, templates));
    }
    return structures;
}

}   // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    if (size > 4096) return 0;
    static const report::Templates templates = short_templates();
    if (size == 0) return 0;
    // The last byte says the place, and which of the writers: they take their time, and share the view model.
    const std::string words(fuzzing::text_of(bytes, size - 1));
    const unsigned place = bytes[size - 1] % 8;
    const report::Document document = document_with(words, place);
    switch (bytes[size - 1] / 8 % 3) {
        case 0: require_balanced(markup_of(report::write_html(document, {}, templates))); break;
        case 1: {
            const std::string page = report::write_markdown(document, {}, templates);
            require_balanced(page);
            static const std::array plain = plain_structures(templates);
            fuzzing::require(words.empty() || structure_of(page) == plain[place], "a word makes no cell of a table and no line");
            break;
        }
        default: fuzzing::require(nlohmann::json::accept(report::write_json(document, {})), "results.json is JSON");
    }
    return 0;
}
