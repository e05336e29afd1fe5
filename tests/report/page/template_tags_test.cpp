// Every documented tag exists, and every existing tag is documented.
#include "report/writers.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "report/batch/batch.h"
#include "report/page/view_model.h"
#include "report/sample_document.h"

namespace meshfolio::report {
namespace {

using nlohmann::json;

/// A text has the same parts everywhere, so its tags are named from the last "runs" on.
std::string short_path(const std::string& path) {
    const std::size_t runs = path.rfind(".runs");
    const bool whole_word = runs != std::string::npos && (runs + 5 == path.size() || path[runs + 5] == '.');
    return whole_word ? path.substr(runs + 1) : path;
}

void collect(const json& value, const std::string& path, std::set<std::string>& tags) {
    if (value.is_array()) {
        for (const json& item : value) collect(item, path, tags);
    } else if (value.is_object()) {
        for (const auto& [name, member] : value.items()) {
            const std::string inner = (path.empty() ? "" : path + ".") + name;
            tags.insert(short_path(inner));
            collect(member, inner, tags);
        }
    }
}

std::set<std::string> tags_of_the_sample() {
    std::set<std::string> tags{"style",  "scheme_script", "script", "has_viewer",     "viewer",
                               "policy", "is_screen",     "labs",   "labs.questions", "labs.data",   // of the page: add_design()
                               "batch",  "version"};
    BatchRow row;
    row.defects = {{"holes", 1}};
    collect(batch_view({{row}}), "batch", tags);
    ViewOptions options;
    options.plot_files = true;
    options.lab_questions = "q1 ";
    for (const DrawnFigures& figures : {sample_models(), sample_layouts()})
        collect(view_model(sample_document(), figures, Templates(), options), "", tags);
    return tags;
}

std::set<std::string> documented_tags() {
    std::set<std::string> tags;
    for (const auto& [tag, meaning] : tag_list()) tags.insert(tag);
    return tags;
}

std::set<std::string> without(std::set<std::string> tags, const std::set<std::string>& others) {
    for (const std::string& tag : others) tags.erase(tag);
    return tags;
}

TEST(TemplateTags, TheListHasEveryTag) {
    for (const std::string& tag : without(tags_of_the_sample(), documented_tags())) ADD_FAILURE() << tag;
}

TEST(TemplateTags, TheListHasOnlyKnownTags) {
    for (const std::string& tag : without(documented_tags(), tags_of_the_sample())) ADD_FAILURE() << tag;
}

TEST(TemplateTags, HaveAMeaningEach) {
    for (const auto& [tag, meaning] : tag_list()) {
        EXPECT_FALSE(meaning.empty()) << tag;
        EXPECT_NE(tag_documentation().find(tag + " "), std::string::npos) << tag;
    }
}

}   // namespace
}   // namespace meshfolio::report
