#include "submission/readiness.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"

namespace meshfolio::submission {

namespace {

using nlohmann::json;

constexpr std::size_t longest_author = 200;   // bytes, as in the settings

std::string name_in(const ReportFolder& report, const char* file) { return (report.path / file).string(); }

const std::string& required_file(const ReportFolder& report, const char* file, const std::string& remedy) {
    const auto found = report.files.find(file);
    if (found == report.files.end()) throw InputError({name_in(report, file), 0}, "is not there", remedy);
    return found->second;
}

void require_questions(const json& results, const std::string& file, const std::vector<std::string>& ids) {
    for (const std::string& id : ids) {
        const json& all = results.at("questions");
        const auto question = std::find_if(all.begin(), all.end(), [&](const json& q) { return q.at("id") == id; });
        const std::string status = question == all.end() ? "missing" : question->at("status").get<std::string>();
        if (status == "ok") continue;
        const std::string why = status == "failed" ? ": " + printable(question->value("failure", "")) : "";
        throw SubmissionError(file, id + " " + (status == "failed" ? "failed" : "is " + status) + why,
                              "answer all questions: meshfolio report without --only");
    }
}

/// Every citation of the report is that of the listing.
void require_citations(const json& results, const std::string& file, const SourceListing& listing) {
    for (const char* kind : {"questions", "supporting"}) {
        for (const json& section : results.at(kind)) {
            for (const json& code : section.at("code")) {
                const auto function = code.at("function").get<std::string>(), source = code.at("file").get<std::string>();
                const int line = listing.line_of(function, source);
                const std::string cited =
                    section.at("id").get<std::string>() + " cites " + printable(function) + " of " + printable(source);
                if (line == 0) throw SubmissionError(file, cited + ", which src.txt does not define", "correct its chapter.cpp");
                if (code.value("line", 0) != line)
                    throw SubmissionError(file, cited + " at another line than " + std::to_string(line), renew);
            }
        }
    }
}

/// Problems that do not prevent a submission.
std::vector<std::string> warnings_of(const json& results) {
    std::vector<std::string> warnings;
    for (const char* kind : {"questions", "supporting"}) {
        for (const json& section : results.at(kind)) {
            const json& checks = section.at("checks");
            const auto with_status = [&](const char* status) {
                return std::count_if(checks.begin(), checks.end(), [&](const json& check) { return check.at("status") == status; });
            };
            const auto id = section.at("id").get<std::string>();
            for (const char* status : {"failed", "undecided"}) {
                const auto count = with_status(status);
                if (count > 0) {
                    warnings.push_back(id + ": " + std::to_string(count) + (count == 1 ? " check " : " checks ") + status +
                                       ", as the report says");
                }
            }
            if (section.at("status") != "ok") warnings.push_back("section " + id + " is " + section.at("status").get<std::string>());
        }
    }
    return warnings;
}

bool has_own_meshes(const json& results) {
    const json& questions = results.at("questions");
    return std::any_of(questions.begin(), questions.end(), [](const json& question) {
        const json& inputs = question.at("inputs");
        return std::any_of(inputs.begin(), inputs.end(), [](const json& i) { return i.at("asked") != "" && !i.at("stand_in"); });
    });
}

/// The name under which it is handed in.
std::string author_of(const std::string& named, const std::string& asked, const std::string& remedy) {
    if (asked.empty() && named.empty()) throw UsageError("whose work it is, is not known", "give --author NAME");
    if (!asked.empty() && !named.empty() && asked != named)
        throw UsageError("the report names '" + printable(named) + "' as its author, not '" + printable(asked) + "'", remedy);
    std::string author = asked.empty() ? named : asked;
    if (author.size() > longest_author || printable(author) != author)
        throw UsageError("--author is no name of at most " + std::to_string(longest_author) + " bytes on one line",
                         "write it out, or leave --author away");
    return author;
}

/// Without computing anything.
std::string to_name_author(const ReportFolder& report) {
    const std::string folder = report.path.string();
    return "meshfolio report --from " + folder + "/results.json --out " + folder + " --author NAME puts another on the report";
}

ReportFacts facts_of(const json& results, const std::string& asked_author, const std::string& remedy) {
    ReportFacts facts;
    facts.title = results.at("title").get<std::string>();
    facts.course = results.at("course").get<std::string>();
    facts.author = author_of(results.at("author").get<std::string>(), asked_author, remedy);
    facts.version = results.at("provenance").at("version").get<std::string>();
    facts.commit = results.at("provenance").at("commit").get<std::string>();
    facts.own_meshes = has_own_meshes(results);
    facts.warnings = warnings_of(results);
    if (results.at("author") == "") facts.warnings.push_back("the name is in INSTRUCTIONS.md alone: the report names nobody; " + remedy);
    return facts;
}

}   // namespace

ReportFacts require_ready(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options) {
    const std::string file = name_in(report, "results.json");
    const std::string& text = required_file(report, "results.json", renew);
    for (const char* page : {"index.html", "appendix.html"}) required_file(report, page, renew);
    if (required_file(report, "src.txt", renew) != listing.text())
        throw InputError({name_in(report, "src.txt"), 0}, "is not the source of this program: the report is of another version", renew);
    try {
        const json results = json::parse(text);
        require_questions(results, file, options.questions);
        require_citations(results, file, listing);
        for (const char* paper : {"report.pdf", "appendix.pdf"}) {
            if (options.pdf &&
                !required_file(report, paper, "print it with meshfolio report --pdf require, or take --without-pdf").starts_with("%PDF-"))
                throw InputError({name_in(report, paper), 0}, "is no PDF", renew);
        }
        return facts_of(results, options.author, to_name_author(report));
    } catch (const json::exception& error) {
        throw InputError({file, 0}, std::string("is not what a report leaves (") + error.what() + ")", renew);
    }
}

}   // namespace meshfolio::submission
