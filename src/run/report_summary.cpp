#include "run/report_summary.h"

#include <set>
#include <string>
#include <vector>

#include "questions/core/section_tools.h"
#include "run/console.h"

namespace meshfolio::run {

namespace {

constexpr int most_lines = 4;   // of a kind: with a line a question and its notes they stay below 40

/// At most `most_lines` of them, then how many more.
void complain_about(const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size() && i < most_lines; ++i) complain(lines[i]);
    if (lines.size() > most_lines) complain("… and " + std::to_string(lines.size() - most_lines) + " more, see the report");
}

}   // namespace

ExitCode summarise(const report::Document& document) {
    std::vector<std::string> failures, checks;
    std::set<std::string> warnings;
    std::size_t undecided = 0;
    for (const report::Section& section : document.sections) {
        if (section.status == report::Status::failed) failures.push_back(section.id + " failed: " + section.failure);
        undecided += report::score_of(section.checks).undecided;
        for (const report::Check& check : section.checks) {
            if (!check.failed()) continue;
            checks.push_back(section.id + ": check failed: " + check.name + ": " + words_of(check) +
                             (check.note.empty() ? "" : " (" + check.note + ")"));
        }
        for (const std::string& warning : section.warnings) warnings.insert("warning: " + warning);
    }
    complain_about({warnings.begin(), warnings.end()});
    complain_about(failures);
    complain_about(checks);
    if (undecided > 0) complain(counted(static_cast<int>(undecided), "check") + " undecided, which is no failure: the report says why");
    return failures.empty() && checks.empty() ? ExitCode::ok : ExitCode::failed;
}

}   // namespace meshfolio::run
