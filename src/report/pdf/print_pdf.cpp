#include "report/pdf/print_pdf.h"

#include <unistd.h>

#include <map>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "report/escape.h"
#include "report/pdf/child_process.h"
#include "report/pdf/pdf_finish.h"
#include "report/pdf/print_page.h"

namespace meshfolio::report {

namespace fs = std::filesystem;

namespace {

constexpr int most_passes = 4;
constexpr std::string_view mark = "@page:";

using PageNumbers = std::map<std::string, int>;   // by the id of the heading

/// Engines say nothing of a picture that is not there, and make links to other files into paths of this machine.
void require_self_contained(const PrintJob& job) {
    for (const std::string_view attribute : {" src=\"", " href=\""}) {
        for (std::size_t at = job.html.find(attribute); at != std::string::npos; at = job.html.find(attribute, at + 1)) {
            const std::size_t begin = at + attribute.size();
            const std::string target = job.html.substr(begin, job.html.find('"', begin) - begin);
            const bool elsewhere = target.starts_with("#") || target.starts_with("data:") || target.starts_with("https://");
            const auto file = job.files.find(target);
            if (!elsewhere && (file == job.files.end() || file->second.empty()))
                throw EngineError("the page to be printed refers to '" + printable(target) + "', which is not there");
        }
    }
}

/// The numbers in place of the marks; "00" for one that is not known, which a browser's script replaces (templates/print_float.js).
/// @return the numbers in their order, parted by blanks
std::string fill_in(std::string& html, const PageNumbers& numbers) {
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

PageNumbers page_numbers(const std::vector<PageHeading>& headings, const PdfContents& contents) {
    if (headings.size() != contents.outline.size())
        throw EngineError("the PDF has " + std::to_string(contents.outline.size()) + " entries in its outline, the page " +
                          std::to_string(headings.size()) + " headings");
    PageNumbers numbers;
    for (std::size_t i = 0; i < headings.size(); ++i) {
        if (!headings[i].id.empty()) numbers[headings[i].id] = contents.outline[i].page;
    }
    return numbers;
}

std::vector<std::string> chromium_arguments(const fs::path& scratch, const fs::path& pdf, bool sandbox) {
    std::vector<std::string> arguments{"--headless",
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
                                       "--generate-pdf-document-outline",
                                       "--no-pdf-header-footer",
                                       "--print-to-pdf=" + pdf.string()};
    if (!sandbox) arguments.emplace_back("--no-sandbox");
    arguments.push_back("file://" + url_path((scratch / "page.html").string()) + "#print");   // templates/print_float.js
    return arguments;
}

/// The engine writes below the scratch folder and nowhere else.
ChildEnd run_engine(const PdfEngine& engine, const fs::path& scratch, const fs::path& pdf, bool sandbox) {
    const std::string home = scratch.string();
    ChildTask task{engine.program,
                   {"page.html", pdf.filename().string()},
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
    if (engine.kind == PdfEngine::Kind::chromium) task.arguments = chromium_arguments(scratch, pdf, sandbox);
    return run_child(task);
}

/// Success is a PDF with pages, whatever the exit code says.
std::string printed(const PdfEngine& engine, const std::string& html, const fs::path& scratch) {
    const fs::path pdf = scratch / "page.pdf";
    std::error_code ignored;
    fs::remove(pdf, ignored);
    write_file(scratch / "page.html", html);
    const bool root = ::geteuid() == 0;
    ChildEnd end = run_engine(engine, scratch, pdf, !root);
    if (!root && !fs::exists(pdf, ignored) && end.output.find("sandbox") != std::string::npos)
        end = run_engine(engine, scratch, pdf, false);
    if (end.kind == ChildEnd::Kind::timed_out || !fs::exists(pdf, ignored))
        throw EngineError(engine.version + " printed no PDF: it " + words_of(end));
    return read_file(pdf);
}

void write_files(const PrintJob& job, const fs::path& scratch) {
    for (const auto& [name, bytes] : job.files) {
        const fs::path folder = (scratch / name).parent_path();
        std::error_code error;
        fs::create_directory(folder, error);   // not its parents: a scratch folder that a signal had removed must not come again
        if (error) throw OutputError(folder.string(), "cannot create the folder (" + error.message() + ")");
        write_file(scratch / name, bytes);
    }
}

}   // namespace

std::string print_pdf(const PrintJob& job, const PdfEngine& engine, const fs::path& scratch) {
    require_self_contained(job);
    const std::vector<PageHeading> headings = headings_of(job.html);
    write_files(job, scratch);
    PageNumbers numbers;
    std::string pdf;
    for (int pass = 0; pass < most_passes; ++pass) {
        std::string html = job.html;
        const std::string told = fill_in(html, numbers);
        pdf = printed(engine, html, scratch);
        const PdfContents contents = contents_of_pdf(pdf);
        if (contents.pages < 1) throw EngineError(engine.version + " printed no page");
        const PageNumbers now = page_numbers(headings, contents);
        std::string unfilled = job.html;
        const std::string right = fill_in(unfilled, now);
        if (told == right || contents.title == right) break;   // the script has left in the title what it filled in
        numbers = now;
    }
    PdfDetails details{job.title, job.author, job.creator, job.date, {}, job.attachment_name, job.attachment};
    for (const PageHeading& heading : headings) details.outline.push_back(heading.title);
    return finish_pdf(pdf, details);
}

}   // namespace meshfolio::report
