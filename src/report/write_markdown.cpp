// report.md for a repository or a job summary: GitHub-flavoured, small enough to be shown whole.
#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "report/escape.h"
#include "report/template_render.h"
#include "report/view_model.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

/// GitHub drops a job summary of 1 MiB whole and stops rendering long files well before that.
constexpr std::size_t size_limit = 256 << 10;

/// No more than one empty line in a row, none at the beginning.
std::string without_gaps(const std::string& text) {
    std::string dense;
    for (const char c : text) {
        const bool third = c == '\n' && (dense.empty() || dense.ends_with("\n\n"));
        if (!third) dense += c;
    }
    return dense;
}

/// The parts under a title of the second order, each with the anchor above its title.
std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t title = text.find("\n## "); title != std::string::npos; title = text.find("\n## ", title + 1)) {
        const std::size_t line_before = text.rfind('\n', title - std::min<std::size_t>(title, 2)) + 1;
        const std::size_t start = text.compare(line_before, 7, "<a id=\"") == 0 ? line_before : title + 1;
        parts.push_back(text.substr(begin, start - begin));
        begin = start;
    }
    parts.push_back(text.substr(begin));
    return parts;
}

/// Does a part answer a question of the assignment? "## 4 Spectral reconstruction", where the others have letters or no number.
bool is_answer(const std::string& part) {
    const std::size_t title = part.find("## ");
    return title != std::string::npos && title + 3 < part.size() && part[title + 3] >= '0' && part[title + 3] <= '9';
}

/// The length that parts may have for all together to fit; those that are `kept` have theirs.
std::size_t length_for(const std::vector<std::string>& parts, const std::function<bool(const std::string&)>& kept) {
    const auto size_with = [&](std::size_t longest) {
        std::size_t sum = 0;
        for (const std::string& part : parts) sum += kept(part) ? part.size() : std::min(part.size(), longest);
        return sum;
    };
    std::size_t fits = 0, too_long = size_limit;
    while (too_long - fits > 1) {
        const std::size_t middle = fits + (too_long - fits) / 2;
        (size_with(middle) <= size_limit ? fits : too_long) = middle;
    }
    return fits;
}

/// The longest parts are cut between two lines, all to the same length and with a word about it. Answers to questions stay whole as long as
/// something is left of the others.
std::string cut(const std::string& text) {
    constexpr std::size_t worth_reading = 3000;
    const std::string note =
        "\n\n*The rest of this part is left out, because this file would be too large to be shown; see* `index.html`.\n\n";
    const std::vector<std::string> parts = parts_of(text);
    std::size_t longest = length_for(parts, is_answer);
    const bool answers_whole = longest >= worth_reading;
    if (!answers_whole) longest = length_for(parts, [](const std::string&) { return false; });
    std::string all;
    for (const std::string& part : parts) {
        const bool whole = part.size() <= longest || (answers_whole && is_answer(part));
        const std::size_t kept = whole ? part.size() : part.rfind('\n', longest - std::min(longest, note.size()));
        all += whole ? part : part.substr(0, kept == std::string::npos ? 0 : kept) + note;
    }
    return all;
}

}   // namespace

std::string write_markdown(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    struct Detail {
        bool single_views;
        std::size_t table_rows;
        bool passed_checks;
    };
    constexpr std::array<Detail, 5> details{
        {{true, 40, true}, {false, 40, true}, {false, 12, true}, {false, 12, false}, {false, 4, false}}};
    const auto told_with = [&](std::size_t i) {
        ViewOptions view;
        view.timings = options.timings;
        view.pictures = false;
        view.plot_files = options.plot_files;
        view.single_views = details[i].single_views;
        view.table_rows = details[i].table_rows;
        view.passed_checks = details[i].passed_checks;
        return without_gaps(render(templates, "report.md", view_model(document, figures, templates, view), markdown_escape));
    };
    // As much as fits, from the middle on: every attempt takes as long as the page itself.
    std::size_t i = details.size() / 2;
    std::string text = told_with(i);
    while (text.size() > size_limit && i + 1 < details.size()) text = told_with(++i);
    if (text.size() > size_limit) return cut(text);
    const bool from_above = i > details.size() / 2;
    while (!from_above && i > 0) {
        std::string more = told_with(--i);
        if (more.size() > size_limit) break;
        text = std::move(more);
    }
    return text;
}

}   // namespace meshfolio::report
