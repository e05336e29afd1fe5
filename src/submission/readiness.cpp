// Whether a report may be submitted.
#include <algorithm>

#include "base/errors.h"
#include "report/json/read_json.h"
#include "report/numbering.h"
#include "submission/submission.h"

namespace meshfolio::submission {

namespace {

using report::Check, report::Section, report::Status;

void require_questions(const report::Document& document, const std::string& file, const std::vector<std::string>& ids) {
    for (const std::string& id : ids) {
        const auto question = std::ranges::find(document.sections, id, &Section::id);
        const bool is_missing = question == document.sections.end();
        if (!is_missing && question->status == Status::ok) continue;
        const bool failed = !is_missing && question->status == Status::failed;
        throw SubmissionError(file,
                              id + (failed       ? " failed: " + printable(question->failure)
                                    : is_missing ? " is missing"
                                                 : " is skipped"),
                              "answer all questions: meshfolio report without --only");
    }
}

/// Requires that every citation of the report is in the listing, at its line.
void require_citations(const report::Document& document, const std::string& file, const SourceListing& listing) {
    for (const Section& section : document.sections) {
        for (const report::CodeReference& code : section.code) {
            const int line = listing.line_of(code.function, code.file);
            const std::string cited = section.id + " cites " + printable(code.function) + " of " + printable(code.file);
            if (line == 0)
                throw SubmissionError(file, cited + ", which src.txt does not define",
                                      "correct the citation in its chapter.cpp, or " + std::string(renew));
            if (code.line != line) throw SubmissionError(file, cited + " at another line than " + std::to_string(line), renew);
        }
    }
}

std::vector<std::string> warnings_of(const report::Document& document) {
    std::vector<std::string> warnings;
    for (const Section& section : document.sections) {
        for (const auto& [status, word] : {std::pair{Check::Status::failed, "failed"}, {Check::Status::undecided, "undecided"}}) {
            const auto count = std::ranges::count(section.checks, status, &Check::status);
            if (count == 0) continue;
            warnings.push_back(section.id + ": " + std::to_string(count) + (count == 1 ? " check " : " checks ") + word +
                               ", as the report says");
        }
        if (section.status != Status::ok)
            warnings.push_back("section " + section.id + " is " + (section.status == Status::failed ? "failed" : "skipped"));
    }
    return warnings;
}

/// Returns the author to submit under. @param named  by the report @param asked  on the command line
std::string author_of(const std::string& named, const std::string& asked, const std::string& remedy) {
    constexpr std::size_t longest = 200;   // bytes, as in the settings
    if (asked.empty() && named.empty()) throw UsageError("the report names no author", "give --author NAME");
    if (!asked.empty() && !named.empty() && asked != named)
        throw UsageError("the report names '" + printable(named) + "' as its author, not '" + printable(asked) + "'", remedy);
    std::string author = asked.empty() ? named : asked;
    if (author.size() > longest || printable(author) != author)
        throw UsageError("the author's name is longer than " + std::to_string(longest) + " bytes, or not on one line",
                         "give a shorter name on one line with --author");
    return author;
}

}   // namespace

ReadyReport require_ready(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options) {
    const auto name = [&](const char* file) { return (report.path / file).string(); };
    const auto required = [&](const char* file, const std::string& remedy) -> const std::string& {
        const auto found = report.files.find(file);
        if (found == report.files.end()) throw InputError({name(file)}, "is not there", remedy);
        return found->second;
    };
    const std::string file = name("results.json"), &results = required("results.json", renew);
    for (const char* page : {"index.html", "appendix.html"}) required(page, renew);
    if (required("src.txt", renew) != listing.text())
        throw InputError({name("src.txt")}, "is not the source of this program: the report is of another version", renew);
    ReadyReport ready{report::read_json(results, file).document, {}, {}};
    require_questions(ready.document, file, options.questions);
    require_citations(ready.document, file, listing);
    for (const char* paper : {"report.pdf", "appendix.pdf"}) {
        if (options.pdf && !required(paper, "print it with meshfolio report --pdf require, or take --without-pdf").starts_with("%PDF-"))
            throw InputError({name(paper)}, "is no PDF", renew);
    }
    const std::string folder = report.path.string(), &named = ready.document.author;
    const std::string remedy =
        "meshfolio report --from " + folder + "/results.json --out " + folder + " --author NAME puts another on the report";
    ready.author = author_of(named, options.author, remedy);
    ready.warnings = warnings_of(ready.document);
    if (named.empty()) ready.warnings.push_back("the name is in INSTRUCTIONS.md alone: the report names nobody; " + remedy);
    return ready;
}

}   // namespace meshfolio::submission
