// report.md for a repository or a job summary: GitHub-flavoured, small enough to be shown whole.
#include <array>
#include <nlohmann/json.hpp>

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

/// Cut between two lines, with a word about it.
std::string cut(std::string text) {
    const std::string note = "\n\n*The rest is left out here, because this file would be too large to be shown; see* `index.html`.\n";
    text.resize(text.rfind('\n', size_limit - note.size()));
    return text + note;
}

}   // namespace

std::string write_markdown(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    struct Detail {
        bool single_views;
        std::size_t table_rows;
    };
    std::string text;
    for (const Detail detail : std::array<Detail, 4>{{{true, 40}, {false, 40}, {false, 12}, {false, 4}}}) {
        ViewOptions view;
        view.timings = options.timings;
        view.pictures = false;
        view.plot_files = options.plot_files;
        view.single_views = detail.single_views;
        view.table_rows = detail.table_rows;
        text = without_gaps(render(templates, "report.md", view_model(document, figures, templates, view), markdown_escape));
        if (text.size() <= size_limit) return text;
    }
    return cut(std::move(text));
}

}   // namespace meshfolio::report
