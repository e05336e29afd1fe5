#include "report/pdf/print_pdf.h"

#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/base64.h"
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
void require_self_contained(const std::string& html) {
    for (const std::string_view attribute : {" src=\"", " href=\""}) {
        for (std::size_t at = html.find(attribute); at != std::string::npos; at = html.find(attribute, at + 1)) {
            const std::size_t begin = at + attribute.size();
            const std::string target = html.substr(begin, html.find('"', begin) - begin);
            const bool elsewhere = target.starts_with("#") || target.starts_with("data:") || target.starts_with("https://");
            if (!elsewhere) throw EngineError("the page to be printed refers to '" + printable(target) + "', which is not in it");
        }
    }
}

/// The numbers in place of the marks; "00" for one that is not known, which a browser's script replaces (templates/print_pages.js).
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

std::vector<std::string> chromium_arguments(const fs::path& scratch, bool sandbox) {
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
                                       "--remote-debugging-pipe"};
    if (!sandbox) arguments.emplace_back("--no-sandbox");
    return arguments;
}

/// Has Chromium print a page by the protocol of its developer tools: a PDF that --print-to-pdf writes goes through a script of the
/// browser first, which takes it half a second for the appendix.
class PrintingByProtocol {
public:
    explicit PrintingByProtocol(const fs::path& page)
        : url_("file://" + url_path(page.string()) + "#print") {}   // templates/print_pages.js

    const std::string& pdf() const { return pdf_; }
    const std::string& refusal() const { return refusal_; }

    /// What to say next. nullopt: nothing, this was the end
    std::optional<std::string> answer(std::string_view message) {
        if (message.find("\"Inspector.targetCrashed\"") < 100) return refused("lost the page");
        if (!message.starts_with(message.empty() ? "" : "{\"id\":" + std::to_string(step_) + ","))
            return "";   // of no command that matters
        if (message.find("\"error\":{") < 100 || message.find("\"errorText\"") < 200) return refused(std::string(message.substr(0, 300)));
        switch (++step_) {
            case 1:
                return command("Target.createTarget", {{"url", "about:blank"}});
            case 2:
                return command("Target.attachToTarget", {{"targetId", value(message, "targetId")}, {"flatten", true}});
            case 3:
                session_ = value(message, "sessionId");
                return command("Inspector.enable");
            case 4:
                return command("Page.navigate", {{"url", url_}});
            case 5:
                return command("Runtime.evaluate", {{"expression", loaded}, {"awaitPromise", true}});
            case 6:
                return command("Page.printToPDF", {{"printBackground", true},
                                                   {"preferCSSPageSize", true},
                                                   {"generateTaggedPDF", true},
                                                   {"generateDocumentOutline", true}});
        }
        pdf_ = from_base64(value(message, "data"));
        return {};
    }

private:
    static constexpr const char* loaded =
        "new Promise(done => document.readyState === 'complete' ? done() : addEventListener('load', () => setTimeout(done)))"
        ".then(() => globalThis.pagesMade)";
    std::string url_, session_, pdf_, refusal_;
    int step_ = 0;   // number of the command that waits for its reply

    std::optional<std::string> refused(std::string why) {
        refusal_ = std::move(why);
        return {};
    }
    std::string command(const char* method, nlohmann::json parameters = nlohmann::json::object()) const {
        nlohmann::json command{{"id", step_}, {"method", method}, {"params", std::move(parameters)}};
        if (!session_.empty()) command["sessionId"] = session_;
        return command.dump();
    }
    /// A text without quotes, which all are that are asked for.
    static std::string_view value(std::string_view message, const std::string& key) {
        const std::string before = "\"" + key + "\":\"";
        const std::size_t at = message.find(before);
        if (at == std::string_view::npos) return {};
        const std::size_t begin = at + before.size();
        return message.substr(begin, message.find('"', begin) - begin);
    }
};

/// The engine writes below the scratch folder and nowhere else.
ChildTask task_of(const PdfEngine& engine, const fs::path& scratch) {
    const std::string home = scratch.string();
    return {engine.program,
            {},
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
}

[[noreturn]] void say_why(const PdfEngine& engine, const std::string& why) {
    throw EngineError(engine.version + " printed no PDF: it " + why);
}

std::string printed_by_chromium(const PdfEngine& engine, const fs::path& scratch, bool sandbox) {
    PrintingByProtocol printing(scratch / "page.html");
    ChildTask task = task_of(engine, scratch);
    task.arguments = chromium_arguments(scratch, sandbox);
    task.answer = [&](std::string_view message) { return printing.answer(message); };
    const ChildEnd end = run_child(task);
    if (!printing.pdf().empty()) return printing.pdf();
    if (sandbox && end.output.find("sandbox") != std::string::npos) return printed_by_chromium(engine, scratch, false);
    say_why(engine, printing.refusal().empty() ? words_of(end) : "said " + printable(printing.refusal()));
}

/// Success is a PDF, whatever the exit code says.
std::string printed_by_weasyprint(const PdfEngine& engine, const fs::path& scratch) {
    const fs::path pdf = scratch / "page.pdf";
    std::error_code ignored;
    fs::remove(pdf, ignored);
    ChildTask task = task_of(engine, scratch);
    task.arguments = {"page.html", "page.pdf"};
    const ChildEnd end = run_child(task);
    if (end.kind == ChildEnd::Kind::timed_out || !fs::exists(pdf, ignored)) say_why(engine, words_of(end));
    return read_file(pdf);
}

std::string printed(const PdfEngine& engine, const std::string& html, const fs::path& scratch) {
    write_file(scratch / "page.html", html);
    if (engine.kind == PdfEngine::Kind::weasyprint) return printed_by_weasyprint(engine, scratch);
    return printed_by_chromium(engine, scratch, ::geteuid() != 0);
}

}   // namespace

std::string print_pdf(const PrintJob& job, const PdfEngine& engine, const fs::path& scratch) {
    require_self_contained(job.html);
    const std::vector<PageHeading> headings = headings_of(job.html);
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
