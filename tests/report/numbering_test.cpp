#include "report/numbering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "report/json/read_json.h"
#include "report/sample_document.h"

namespace meshfolio::report {
namespace {

Numbering sample_numbering() { return Numbering(sample_document(), bibliography_of(Templates())); }

/// The message of the logic_error; empty if none is thrown.
template <class Action> std::string complaint(Action action) {
    try {
        action();
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

TEST(Numbering, PlotsMapsAndFiguresShareOneCount) {
    const Numbering numbering = sample_numbering();
    EXPECT_EQ(numbering.resolve("q1_plane_h").label, "Figure 1.1");
    EXPECT_EQ(numbering.resolve("q1_missing").label, "Figure 1.2");
    EXPECT_EQ(numbering.resolve("q1_error_versus_k").label, "Figure 1.3");
    EXPECT_EQ(numbering.resolve("q1_error_map").label, "Figure 1.4");
    EXPECT_EQ(numbering.resolve("q1_errors").label, "Table 1.1");
    EXPECT_EQ(numbering.resolve("q1_long").label, "Table 1.2");
    EXPECT_EQ(numbering.resolve("q1_eq").label, "Equation (1.1)");
    EXPECT_EQ(numbering.resolve("q1").label, "Question 1");
    EXPECT_EQ(numbering.resolve("ground_truth").label, "Section A");
}

TEST(Numbering, CitedWorksAreNumberedInTheirOrder) {
    const auto works = bibliography_of(Templates());
    EXPECT_EQ(sample_numbering().resolve(works.front().id).label, "[1]");
    EXPECT_EQ(sample_numbering().resolve(works.back().id).label, "[" + std::to_string(works.size()) + "]");
}

// q2 failed and q9 was not asked for: a reference to them must not take the report down.
TEST(Numbering, PartsOfUnansweredQuestionsHaveTheLabelOfTheQuestion) {
    EXPECT_EQ(sample_numbering().resolve("q2_plot").label, "Question 2");
    EXPECT_EQ(sample_numbering().resolve("q2_plot").anchor, "q2");
    EXPECT_EQ(sample_numbering().resolve("q9_plot").label, "Question 9");
    EXPECT_EQ(sample_numbering().resolve("q9_plot").anchor, "");
}

TEST(Numbering, PartsOfAFailedSupportingSectionHaveItsLabel) {
    Document document;
    document.sections.resize(2);
    document.sections[0].id = "truth";
    document.sections[1].id = "certificates";
    document.sections[0].status = Status::skipped;
    const Numbering numbering(document, {});
    EXPECT_EQ(numbering.resolve("truth_overview").label, "Section A");
    EXPECT_EQ(numbering.resolve("truth_overview").anchor, "truth");
    EXPECT_NE(complaint([&] { (void)numbering.resolve("certificates_table"); }).find("certificates_table"), std::string::npos);
}

// Questions that were not asked for have no number and no link; letters are those of the sections that are shown.
TEST(Numbering, SectionsNotAskedForAreNotCounted) {
    Document document;
    document.sections.resize(3);
    for (std::size_t i = 0; i < 3; ++i) document.sections[i].id = std::vector{"q1", "truth", "modes"}[i];
    for (std::size_t i = 0; i < 2; ++i) {
        document.sections[i].title = "A & B";
        document.sections[i].status = Status::skipped;
        document.sections[i].extent = not_asked_for;
    }
    EXPECT_EQ(section_numbers(document), (std::vector<std::string>{"", "", "A"}));
    const Reference hidden = Numbering(document, {}).resolve("truth_overview");
    EXPECT_EQ(hidden.label, "“A & B” (not in this report)");
    EXPECT_TRUE(hidden.anchor.empty() && !hidden.is_shown);
}

TEST(Numbering, QuestionsAreSortedByTheirNumbersAndOtherSectionsStayBehind) {
    Document document;
    for (const auto& [id, number] : {std::pair{"truth", ""}, {"q2", "10"}, {"q3", "2b"}, {"q5", "2"}, {"modes", ""}, {"q1", ""}}) {
        Section& section = document.sections.emplace_back();
        section.id = id;
        section.number = number;
    }
    sort_by_number(document);
    std::string order;
    for (const Section& section : document.sections) order += section.id + " ";
    EXPECT_EQ(order, "q1 q5 q3 q2 truth modes ");
    EXPECT_EQ(Numbering(document, {}).resolve("q3").label, "Question 2b");
}

// A table for programs alone takes no number, and no page shows it; files keep it.
TEST(Numbering, TablesForFilesAloneHaveNoNumber) {
    Document document = sample_document();
    auto& blocks = document.sections[0].blocks;
    const auto first = std::ranges::find_if(blocks, [](const Block& block) { return std::holds_alternative<Table>(block); });
    std::get<Table>(*first).file_only = true;
    const Table kept = std::get<Table>(*first);
    document.sections[0].answer.clear();
    std::erase_if(blocks, [&](const Block& b) {   // what refers to it, and what refers to that
        const auto* table = std::get_if<Table>(&b);
        return table == nullptr || (table->id != kept.id && table->id != "q1_long");
    });
    const Numbering numbering(document, {});
    EXPECT_THROW((void)numbering.resolve(kept.id), std::logic_error);
    EXPECT_EQ(numbering.resolve("q1_long").label, "Table 1.1");
    EXPECT_EQ(write_html(document, {}, Templates()).find(kept.caption), std::string::npos);
    const Document read = read_json(write_json(document, {}), "results.json").document;
    const auto& again = std::get<Table>(read.sections[0].blocks.front());
    EXPECT_EQ(again.id, kept.id);
    EXPECT_TRUE(again.file_only);
}

TEST(Numbering, UnknownIdIsNamed) {
    EXPECT_NE(complaint([] { (void)sample_numbering().resolve("q1_nothing"); }).find("q1_nothing"), std::string::npos);
    EXPECT_NE(complaint([] { (void)sample_numbering().resolve("qx"); }).find("qx"), std::string::npos);
}

TEST(Numbering, IdUsedTwiceIsNamed) {
    Document document = sample_document();
    document.sections[3].blocks.push_back(Figure{"q1_errors", "", ""});
    EXPECT_NE(complaint([&] { Numbering(document, {}); }).find("q1_errors"), std::string::npos);
}

}   // namespace
}   // namespace meshfolio::report
