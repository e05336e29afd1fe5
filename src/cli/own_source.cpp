#include "cli/own_source.h"

#include "build_info.h"
#include "questions/cited_code.h"
#include "questions/question.h"

namespace meshfolio::cli {

namespace {

/// Questions by their numbers, supporting sections by their letters, as in the report.
std::vector<submission::CitingSection> index_of_sections() {
    std::vector<submission::CitingSection> index;
    const auto add = [&](const Question& question, std::string label) {
        index.push_back({std::move(label), std::string(question.title), cited_code(question.id)});
    };
    int number = 0;
    for (const Question& question : question_list()) add(question, "Q" + std::to_string(++number));
    char letter = 'A';
    for (const Question& question : supporting_list()) add(question, std::string(1, letter++));
    return index;
}

}   // namespace

const submission::SourceListing& own_source() {
    static const submission::SourceListing listing("meshfolio " + std::string(build_info::version) + ": all source of its own",
                                                   submission::source_tree(), index_of_sections());
    return listing;
}

}   // namespace meshfolio::cli
