#include "submission/instructions.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/escape.h"
#include "report/page/template_render.h"
#include "report/writers.h"

namespace meshfolio::submission {

namespace {

using nlohmann::json;

std::string words_of(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
    return line;
}

std::string packages_of(const std::vector<SourceFile>& tree) {
    const auto setup = std::find_if(tree.begin(), tree.end(), [](const SourceFile& f) { return f.path == "tests/setup.sh"; });
    return words_of(build_packages(setup == tree.end() ? std::string_view() : setup->bytes));
}

json citations_view(const SourceListing& listing) {
    json list = json::array();
    for (const CitingSection& section : listing.index()) {
        for (const report::CodeReference& code : section.code) {
            list.push_back(
                {{"section", section.label}, {"line", std::to_string(code.line)}, {"function", code.function}, {"file", code.file}});
        }
    }
    return list;
}

}   // namespace

std::string instructions(const ReportFacts& facts, const SourceListing& listing, const std::vector<SourceFile>& tree,
                         const SubmissionOptions& options) {
    const json model = {{"title", report::safe_text(facts.title)},
                        {"author", report::safe_text(facts.author)},
                        {"course", report::safe_text(facts.course)},
                        {"has_course", !facts.course.empty()},
                        {"version", facts.version},
                        {"commit", facts.commit},
                        {"has_commit", !facts.commit.empty() && facts.commit != "unknown"},
                        {"has_pdf", options.pdf},
                        {"has_images", options.images},
                        {"has_own_meshes", facts.own_meshes},
                        {"packages", packages_of(tree)},
                        {"citations", citations_view(listing)}};
    return report::render(report::Templates(), "instructions.md", model, report::markdown_escape);
}

}   // namespace meshfolio::submission
