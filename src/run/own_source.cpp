#include "run/own_source.h"

#include "build_info.h"
#include "questions/core/chapter.h"

namespace meshfolio::run {

namespace {

/// Questions by their numbers, supporting sections by their letters, as in the report.
std::vector<submission::CitingSection> index_of_sections() {
    std::vector<submission::CitingSection> index;
    char letter = 'A';
    for (const Chapter* chapter : chapter_list()) {
        std::string label = chapter->is_question() ? "Q" + std::string(chapter->id.substr(1)) : std::string(1, letter++);
        index.push_back({std::move(label), chapter->title(), chapter->cited_code()});
    }
    return index;
}

}   // namespace

const submission::SourceListing& own_source() {
    static const submission::SourceListing listing("meshfolio " + std::string(build_info::version) + ": all source of its own",
                                                   submission::source_tree(), index_of_sections());
    return listing;
}

}   // namespace meshfolio::run
