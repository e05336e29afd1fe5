#include "report/pdf/print_pdf.h"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/child_process.h"
#include "base/errors.h"
#include "base/file_bytes.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_model.h"
#include "report/pdf/pdf_finish.h"

namespace meshfolio::report {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t table_rows = 16;   // tables half as long again and longer show their first and last rows
constexpr int most_passes = 4;

using PageNumbers = std::map<std::string, int>;   // by the id of the heading

/// Returns the text of HTML: without tags, with entities resolved, and with one space for spaces and line ends.
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
    if (text.ends_with(' ')) text.pop_back();
    return text;
}

/// Throws if the page refers to other files: engines pass over missing pictures silently and print links as paths of this machine.
void require_self_contained(const std::string& html) {
    for (const std::string_view attribute : {" src=\"", " href=\""}) {
        for (std::size_t at = html.find(attribute); at != std::string::npos; at = html.find(attribute, at + 1)) {
            const std::size_t begin = at + attribute.size();
            const std::string target = html.substr(begin, html.find('"', begin) - begin);
            const bool inside = target.starts_with("#") || target.starts_with("data:") || target.starts_with("https://");
            if (!inside) throw EngineError("the page to be printed refers to '" + printable(target) + "', which is not in it");
        }
    }
}

/// Replaces the marks "@page:ID@" by numbers; unknown ones by "00", which the script of a browser replaces (templates/print_pages.js).
/// @return the numbers in their order, separated by spaces
std::string fill_in(std::string& html, const PageNumbers& numbers) {
    constexpr std::string_view mark = "@page:";
    std::string all;
    for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at + 1)) {
        const std::size_t begin = at + mark.size(), end = html.find('@', begin);
        if (end == std::string::npos) break;
        const auto number = numbers.find(html.substr(begin, end - begin));
        const std::string digits = number == numbers.end() ? "00" : std::to_string(number->second);
        html.replace(at, end + 1 - at, digits);
        all += (all.empty() ? "" : " ") + digits;
    }
    return all;
}

/// Returns the arguments with which the engine prints page.html to page.pdf, both in the scratch folder.
std::vector<std::string> arguments_of(const PdfEngine& engine, const fs::path& scratch) {
    if (engine.kind == PdfEngine::Kind::weasyprint) return {"page.html", "page.pdf"};
    return {"--headless",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--user-data-dir=" + (scratch / "profile").string(),
            "--no-first-run",
            "--no-default-browser-check",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--disable-default-apps",
            "--disable-extensions",
            "--disable-quic",
            "--hide-scrollbars",
            "--force-color-profile=srgb",
            "--font-render-hinting=none",
            "--virtual-time-budget=60000",   // [ms] that pass at once when the page has nothing to do: its scripts end before it is printed
            "--no-pdf-header-footer",
            "--generate-pdf-document-outline",
            "--print-to-pdf=" + (scratch / "page.pdf").string(),
            "file://" + url_path((scratch / "page.html").string()) + "#print"};   // templates/print_pages.js
}

/// Prints a page with an engine that writes below the scratch folder alone. A PDF is a success, whatever the exit code says.
std::string printed(const PdfEngine& engine, const std::string& html, const fs::path& scratch) {
    const std::string home = scratch.string();
    const fs::path pdf = scratch / "page.pdf";
    std::error_code ignored;
    fs::remove(pdf, ignored);   // of an earlier pass
    write_file(scratch / "page.html", html);
    ChildTask task{engine.program,
                   arguments_of(engine, scratch),
                   {{"HOME", home},
                    {"TMPDIR", home},
                    {"XDG_CONFIG_HOME", home + "/config"},
                    {"XDG_CACHE_HOME", home + "/cache"},
                    {"XDG_DATA_HOME", home + "/data"},
                    {"XDG_RUNTIME_DIR", home},
                    {"TZ", "UTC"},
                    {"LC_ALL", "C.UTF-8"},
                    {"LANGUAGE", "en"}},
                   scratch};
    const bool is_browser = engine.kind == PdfEngine::Kind::chromium;
    const auto without_sandbox = [&] { task.arguments.insert(task.arguments.begin(), "--no-sandbox"); };
    if (is_browser && ::geteuid() == 0) without_sandbox();
    ChildEnd end = run_child(task);
    if (is_browser && end.kind != ChildEnd::Kind::timed_out && !fs::exists(pdf, ignored) && end.output.find("sandbox") != end.output.npos) {
        without_sandbox();
        end = run_child(task);
    }
    if (end.kind == ChildEnd::Kind::timed_out || !fs::exists(pdf, ignored))
        throw EngineError(engine.version + " printed no PDF: it " + words_of(end));
    return read_file(pdf);
}

}   // namespace

std::string print_page(const Document& document, const DrawnFigures& figures, const Templates& templates, const PrintOptions& options) {
    const ViewOptions view{.volume = options.volume,
                           .timings = false,
                           .page_numbers = options.page_numbers,
                           .plain_formulas = !options.mathml,
                           .columns = options.volume == Volume::report,
                           .single_views = false,
                           .passed_checks = false,   // results.json, attached to the report, has them all
                           .table_rows = table_rows,
                           .fewest_left_out = table_rows / 2};   // a smaller gap would save nothing
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

std::string print_pdf(const PrintJob& job, const PdfEngine& engine, const fs::path& scratch) {
    require_self_contained(job.html);
    const std::vector<PageHeading> headings = headings_of(job.html);
    PageNumbers numbers;
    std::string pdf;
    for (int pass = 0; pass < most_passes; ++pass) {
        std::string html = job.html, unfilled = job.html;
        const std::string filled_in = fill_in(html, numbers);
        pdf = printed(engine, html, scratch);
        const PdfContents contents = contents_of_pdf(pdf);
        if (contents.pages < 1) throw EngineError(engine.version + " printed no page");
        if (headings.size() != contents.outline.size())
            throw EngineError("the PDF has " + std::to_string(contents.outline.size()) + " entries in its outline, the page " +
                              std::to_string(headings.size()) + " headings");
        for (std::size_t i = 0; i < headings.size(); ++i)
            if (!headings[i].id.empty()) numbers[headings[i].id] = contents.outline[i].page;
        const std::string right = fill_in(unfilled, numbers);
        if (filled_in == right || contents.title == right) break;   // the script leaves the numbers it has filled in as the title
    }
    PdfDetails details{job.title, job.author, job.creator, job.date, {}, job.attachment_name, job.attachment};
    for (const PageHeading& heading : headings) details.outline.push_back(heading.title);
    return finish_pdf(pdf, details);
}

}   // namespace meshfolio::report
