// What the report cites, against src.txt as this program writes it.
#include "run/provenance.h"

#include <gtest/gtest.h>

#include <sstream>

#include "questions/core/chapter.h"
#include "run/settings/report_settings.h"
#include "submission/source_listing.h"

using namespace meshfolio;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}   // namespace

TEST(OwnSource, EveryCitationOfEverySectionIsTheLineOfADefinition) {
    const submission::SourceListing& listing = run::own_source();
    const auto lines = lines_of(listing.text());
    for (const std::string& id : section_ids()) {
        const auto code = chapter_of_id(id).cited_code();
        EXPECT_GE(code.size(), 3u) << id << ": its chapter cites at least three definitions (Chapter::code)";
        for (const report::CodeReference& reference : code) {
            const int line = listing.line_of(reference.function, reference.file);
            ASSERT_GT(line, 0) << id << " cites " << reference.function << " of " << reference.file << ", which does not define it";
            const std::string& text = lines[static_cast<std::size_t>(line) - 1];
            EXPECT_EQ(std::stoi(text.substr(0, 6)), line);
            const bool is_class =
                text.find("class " + reference.function) != text.npos || text.find("struct " + reference.function) != text.npos;
            EXPECT_TRUE(is_class || text.find(" " + reference.function + "(") != text.npos ||
                        text.find(reference.function + "::" + reference.function + "(") != text.npos)
                << text;
            EXPECT_FALSE(text.ends_with(";")) << "a declaration: " << text;
        }
    }
}

/// Of the first file of a part, by its title in the list of files.
std::size_t first_line_of(const std::vector<std::string>& lines, const std::string& title) {
    const auto at = std::ranges::find_if(lines, [&](const std::string& line) { return line.ends_with(title); });
    EXPECT_NE(at, lines.end()) << title;
    return std::stoul(at->substr(at->find('L', 6) + 1));
}

TEST(OwnSource, AnsweringSourceIsWithinTheFirstFifteenThousandLines) {
    const submission::SourceListing& listing = run::own_source();
    const auto lines = lines_of(listing.text());
    const std::size_t end = first_line_of(lines, "The rest of the mathematics");
    EXPECT_LE(end, 15'000u);
    EXPECT_GT(end, 10'000u);
    for (const auto& section : listing.index()) {
        if (!section.label.starts_with('Q')) continue;
        for (const report::CodeReference& code : section.code)
            EXPECT_LT(std::size_t(code.line), end) << section.label << " cites " << code.function << " of " << code.file;
    }
}

TEST(OwnSource, EveryQuestionCitesItsOwnFile) {
    for (const Chapter* chapter : chapter_list()) {
        const std::string folder = "src/questions/" + std::string(chapter->id) + "_";
        EXPECT_TRUE(!chapter->is_question() ||
                    std::ranges::any_of(chapter->cited_code(), [&](const auto& reference) { return reference.file.starts_with(folder); }))
            << chapter->id << " cites nothing of " << folder << "…: see Chapter::code";
    }
}

TEST(OwnSource, TheIndexNamesAllSectionsWithTheirLines) {
    const auto& index = run::own_source().index();
    ASSERT_EQ(index.size(), chapter_list().size());
    EXPECT_EQ(index.front().label, "Q1");
    const auto questions = std::ranges::count_if(chapter_list(), &Chapter::is_question);
    EXPECT_EQ(index[static_cast<std::size_t>(questions)].label, "A");
    for (const auto& section : index) {
        for (const report::CodeReference& code : section.code) EXPECT_GT(code.line, 0) << section.label << " " << code.function;
    }
}
