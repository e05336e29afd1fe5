// report.md for a repository or a job summary: GitHub-flavoured, small enough to be shown whole.
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/escape.h"
#include "report/markdown/shortened_markdown.h"
#include "report/page/template_render.h"
#include "report/page/view_model.h"
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

}   // namespace

std::string write_markdown(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    struct Detail {
        bool single_views;
        std::size_t table_rows;
        bool passed_checks;
    };
    constexpr std::array<Detail, 5> details{
        {{true, 40, true}, {false, 40, true}, {false, 12, true}, {false, 12, false}, {false, 4, false}}};
    const auto written_with = [&](std::size_t i) {
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
    std::string text = written_with(i);
    while (text.size() > size_limit && i + 1 < details.size()) text = written_with(++i);
    if (text.size() > size_limit) return shortened_markdown(text, size_limit);
    const bool from_above = i > details.size() / 2;
    while (!from_above && i > 0) {
        std::string more = written_with(--i);
        if (more.size() > size_limit) break;
        text = std::move(more);
    }
    return text;
}

}   // namespace meshfolio::report
