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
                              "answer all questions: meshfolio report without --only; or name the settings of another sheet with --config");
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
    ReadyReport ready{report::read_json(results, file).document, {}, {}};
    const bool has_source = report::cites_source(ready.document);
    if (has_source && required("src.txt", renew) != listing.text())
        throw InputError({name("src.txt")}, "is not the source of this program: the report is of another version", renew);
    require_questions(ready.document, file, options.questions);
    if (has_source) require_citations(ready.document, file, listing);
    for (const char* paper : {"report.pdf", "appendix.pdf"}) {
        if (options.pdf && !required(paper, "print it with meshfolio report --pdf require, or take --without-pdf").starts_with("%PDF-"))
            throw InputError({name(paper)}, "is no PDF", renew);
    }
    ready.author = options.author.empty() ? ready.document.author : options.author;
    if (ready.author.empty()) throw UsageError("the report names no author", "give --author NAME");
    ready.is_complete = has_source && ready.author == ready.document.author;
    ready.warnings = warnings_of(ready.document);
    return ready;
}

}   // namespace meshfolio::submission
