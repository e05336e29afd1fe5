#include "report/pdf/print_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"

namespace meshfolio::report {

namespace {

constexpr std::size_t table_rows = 16;   // tables half as long again and longer show their first and last rows

/// Without tags, entities resolved, spaces and line ends as one space each.
std::string text_of(const std::string& html) {
    static const std::pair<std::string_view, char> entities[] = {
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
    std::string text;
    for (std::size_t i = 0; i < html.size(); ++i) {
        char c = html[i];
        if (c == '<') {
            i = std::min(html.find('>', i), html.size());
            continue;
        }
        for (const auto& [entity, character] : entities) {
            if (html.compare(i, entity.size(), entity) != 0) continue;
            c = character;
            i += entity.size() - 1;
            break;
        }
        const bool space = c == ' ' || c == '\n' || c == '\t';
        if (!space) text += c;
        if (space && !text.empty() && text.back() != ' ') text += ' ';
    }
    if (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

}   // namespace

std::string print_page(const Document& document, const DrawnFigures& figures, const Templates& templates, const PrintOptions& options) {
    ViewOptions view;
    view.timings = false;
    view.page_numbers = options.page_numbers;
    view.plain_formulas = !options.mathml;
    view.single_views = false;
    view.columns = options.volume == Volume::report;
    view.volume = options.volume;
    view.passed_checks = false;   // results.json, attached to the report, has them all
    view.table_rows = table_rows;
    view.fewest_left_out = table_rows / 2;   // a gap in a table hardly longer spares nothing
    nlohmann::json model = view_model(document, figures, templates, view);
    add_design(model, templates, "print");
    return render(templates, "print.html", model, xml_escape);
}

std::vector<PageHeading> headings_of(const std::string& html) {
    std::vector<PageHeading> headings;
    for (std::size_t at = html.find("<h"); at != std::string::npos; at = html.find("<h", at + 1)) {
        const char level = at + 2 < html.size() ? html[at + 2] : ' ';
        if (level < '1' || level > '6') continue;
        const std::size_t begin = html.find('>', at), end = html.find(std::string("</h") + level, at);
        if (begin == std::string::npos || end == std::string::npos || end < begin) break;
        const std::string tag = html.substr(at, begin - at);
        const std::size_t id = tag.find(" id=\"");
        const std::string name = id == std::string::npos ? "" : tag.substr(id + 5, tag.find('"', id + 5) - id - 5);
        headings.push_back({name, text_of(html.substr(begin + 1, end - begin - 1)), level - '0'});
        at = end;
    }
    return headings;
}

}   // namespace meshfolio::report
