#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "questions/truth/parts.h"
#include "report/bibliography.h"
#include "report/writers.h"

namespace meshfolio::truth {

namespace {

const GroundTruth& quick_truth() {
    static const GroundTruth truth = ground_truth(MeshLibrary({}, {}), 1, true, [](std::string_view) {});
    return truth;
}

}   // namespace

TEST(GroundTruth, AllChecksHold) {
    const std::vector<report::Check> checks = ground_truth_checks(quick_truth());
    EXPECT_GE(checks.size(), 50u);
    std::set<std::string> names;
    for (const report::Check& check : checks) {
        EXPECT_TRUE(check.passed()) << check.name << ": " << check.measured;
        EXPECT_TRUE(names.insert(check.name).second) << "twice: " << check.name;
    }
}

TEST(GroundTruth, ChecksFailIfAnEstimatorIsWrong) {
    const auto failures = [](const GroundTruth& truth) {
        int failed = 0;
        for (const report::Check& check : ground_truth_checks(truth)) failed += check.passed() ? 0 : 1;
        return failed;
    };
    GroundTruth doubled = quick_truth();   // as from areas twice too large: H is off by a half, everywhere
    for (BenchRun& run : doubled.runs)
        for (BenchLevel& level : run.levels)
            for (auto& [key, error] : level.errors) error.l2 += key.starts_with("H.") ? 0.5 : 0;
    EXPECT_GT(failures(doubled), 5);
    GroundTruth jet = quick_truth();
    jet.reference.errors["H.jet"].l2 *= 1.2;
    EXPECT_EQ(failures(jet), 1);
}

// The numbers of the answer stand in the table that it cites.
TEST(GroundTruth, TheAnswerCitesTheTableOfItsNumbers) {
    const report::Section section = ground_truth_section(quick_truth());
    const auto named = std::ranges::find(section.answer, report::Run::Kind::reference, &report::Run::kind);
    ASSERT_NE(named, section.answer.end());
    std::set<std::string> cells;
    for (const report::Block& block : section.blocks) {
        const auto* table = std::get_if<report::Table>(&block);
        if (!table || table->id != named->content) continue;
        for (const auto& row : table->rows)
            for (const report::Cell& cell : row)
                if (const auto* percent = std::get_if<double>(&cell)) cells.insert(readable_percent(*percent / 100, 2));
    }
    const std::string answer = report::plain(section.answer);
    for (const char* key : {"H.mixed", "H.jet"}) {
        const std::string error = readable_percent(quick_truth().run("ellipsoid", MeshKind::random).finest().error(key).l2, 2);
        EXPECT_NE(answer.find(error), std::string::npos) << answer;
        EXPECT_TRUE(cells.contains(error)) << named->content << " lacks " << error;
    }
}

TEST(GroundTruth, SectionIsWellFormedAndCanBeWritten) {
    report::Document document;
    document.sections.push_back(ground_truth_section(quick_truth()));
    for (const report::Block& block : document.sections[0].blocks) {
        if (const auto* table = std::get_if<report::Table>(&block)) {
            for (const auto& row : table->rows) EXPECT_EQ(row.size(), table->columns.size()) << table->id;
        }
        if (const auto* paragraph = std::get_if<report::Paragraph>(&block)) {
            EXPECT_EQ(report::plain(paragraph->text).find("nan"), std::string::npos) << report::plain(paragraph->text);
        }
    }
    EXPECT_FALSE(report::write_html(document, {}, report::Templates()).empty());   // throws where a reference leads nowhere
    EXPECT_FALSE(report::write_json(document, {}).empty());
    const report::Table all = ground_truth_table(quick_truth());
    EXPECT_EQ(all.rows.size(),
              quick_truth().runs.size() * 3 * (panel_estimators(Quantity::H).size() + panel_estimators(Quantity::K).size()));
    EXPECT_EQ(all.rows[0].size(), all.columns.size());
}

}   // namespace meshfolio::truth
