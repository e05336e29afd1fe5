// report.md and appendix.md for a repository, and summary.md for the summary of a CI job: GitHub-flavoured.
#include <nlohmann/json.hpp>

#include "report/escape.h"
#include "report/page/template_render.h"
#include "report/page/view_model.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

/// The largest file [bytes] that GitHub renders.
constexpr std::size_t size_limit = 256 << 10;
constexpr std::size_t summary_limit = 20'000;

/// Returns a text without a second empty line in a row, and without empty lines at the beginning.
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
    ViewOptions view;
    view.volume = options.volume;
    view.other_page = markdown_file(other_of(options.volume));
    view.timings = options.timings;
    view.pictures = false;
    view.plot_files = options.plot_files;
    std::string text;
    for (const std::size_t rows : {40, 12, 4}) {   // as many rows of long tables as fit; with fewer, only the checks that did not pass
        view.table_rows = rows;
        view.passed_checks = rows > 12;
        text = without_gaps(render(templates, "report.md", view_model(document, figures, templates, view), markdown_escape));
        if (text.size() <= size_limit) break;
    }
    return text;
}

std::string write_summary(const Document& document, const Templates& templates) {
    ViewOptions view{.other_page = page_file(Volume::appendix), .timings = false, .pictures = false, .passed_checks = false};
    std::string text;
    for (const std::size_t checks : {20, 4, 1, 0}) {   // of each section
        view.most_checks = checks;
        text = without_gaps(render(templates, "summary.md", view_model(document, {}, templates, view), markdown_escape));
        if (text.size() <= summary_limit) return text;
    }
    return text.substr(0, text.rfind('\n', summary_limit - 1) + 1);
}

}   // namespace meshfolio::report
