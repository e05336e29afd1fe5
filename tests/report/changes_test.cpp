#include "report/changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sample_document.h"

namespace meshfolio::report {
namespace {

using Kind = Change::Kind;

std::vector<Change> changes(const Document& before, const Document& after, double tolerance = default_tolerance) {
    ComparedParts compared;
    return changes_between(before, after, tolerance, compared);
}

Table& first_table(Document& document) {
    for (Block& block : document.sections[0].blocks)
        if (auto* table = std::get_if<Table>(&block)) return *table;
    throw std::logic_error("the sample has a table");
}

/// Returns the first number of a table that is no key, and its place.
double& number_in(Table& table) {
    for (std::size_t c = table.columns.size(); c-- > 0;)
        for (auto& row : table.rows)
            if (auto* number = std::get_if<double>(&row[c]); number != nullptr && std::isfinite(*number) && *number != 0) return *number;
    throw std::logic_error("the table has a number");
}

TEST(Changes, AReportEqualsItself) {
    ComparedParts compared;
    const Document document = sample_document();
    EXPECT_TRUE(changes_between(document, document, 0, compared).empty());
    EXPECT_GT(compared.numbers, 400);
    EXPECT_GT(compared.checks, 3);
}

TEST(Changes, ANumberMovesBeyondTheToleranceAlone) {
    const Document before = sample_document();
    Document after = before;
    number_in(first_table(after)) *= 1 + 1e-6;
    EXPECT_TRUE(changes(before, after, 2e-6).empty());
    const std::vector<Change> found = changes(before, after, 5e-7);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::number);
    EXPECT_EQ(found[0].id, first_table(after).id);
    EXPECT_NEAR(found[0].size, 1e-6, 1e-9);
    EXPECT_FALSE(found[0].row.empty() || found[0].column.empty());
}

TEST(Changes, AnUndefinedNumberIsAnInfiniteChange) {
    const Document before = sample_document();
    Document after = before;
    number_in(first_table(after)) = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Change> found = changes(before, after, 1);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].after, "");
    EXPECT_TRUE(std::isinf(found[0].size));
}

// Rows are matched by their keys, so that a new first row is one change.
TEST(Changes, RowsAreMatchedByTheirFirstCells) {
    Document before = sample_document();
    Table table{"q1_rows", "Rows.", {{"surface"}, {"level"}, {"error"}}, {}};
    for (const char* surface : {"sphere", "torus"})
        for (const double level : {1.0, 2.0}) table.rows.push_back({std::string(surface), level, 0.5 / level});
    before.sections[0].blocks.emplace_back(table);
    Document after = before;
    auto& rows = std::get<Table>(after.sections[0].blocks.back()).rows;
    std::ranges::reverse(rows);
    EXPECT_TRUE(changes(before, after).empty());
    rows.insert(rows.begin(), {std::string("cube"), 1.0, 0.25});
    const std::vector<Change> came = changes(before, after);
    ASSERT_EQ(came.size(), 1u);
    EXPECT_EQ(came[0].kind, Kind::presence);
    EXPECT_EQ(came[0].row, "cube, 1");
    rows[1][2] = 0.75;
    const std::vector<Change> moved = changes(before, after);
    ASSERT_EQ(moved.size(), 2u);
    EXPECT_EQ(moved[0].row, "torus, 2") << "numbers come before what came or went";
    EXPECT_EQ(moved[0].before, "0.25");
}

TEST(Changes, ChecksThatFailComeFirst) {
    Document before = sample_document();
    for (Check& check : before.sections[0].checks) check.status = Check::Status::passed;
    ASSERT_GE(before.sections[0].checks.size(), 3u);
    Document after = before;
    after.sections[0].checks[0].status = Check::Status::undecided;
    after.sections[0].checks[1].status = Check::Status::failed;
    after.sections[0].checks.pop_back();
    const std::vector<Change> found = changes(before, after);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].size, 3);
    EXPECT_EQ(found[1].after, "") << "one that is gone";
    EXPECT_EQ(found[2].size, 1);
    const std::vector<Change> back = changes(after, before);
    EXPECT_TRUE(std::ranges::all_of(back, [](const Change& change) { return change.size == 0; }));
}

TEST(Changes, SayWhatTheReportsWereMadeOf) {
    const Document before = sample_document();
    Document after = before;
    after.provenance.version = "9.9";
    after.provenance.settings["size"] = "17";
    ASSERT_FALSE(after.sections[0].inputs.empty());
    after.sections[0].inputs[0].sha256 = std::string(64, '0');
    after.sections[1].status = Status::skipped;
    std::vector<Kind> kinds;
    for (const Change& change : changes(before, after)) kinds.push_back(change.kind);
    EXPECT_EQ(kinds, (std::vector<Kind>{Kind::program, Kind::setting, Kind::input, Kind::presence}));
}

TEST(Changes, APlotIsComparedByItsPoints) {
    const Document before = sample_document();
    Document after = before;
    for (Block& block : after.sections[0].blocks)
        if (auto* plot = std::get_if<Plot>(&block)) plot->series[0].y[0] += 1;
    const std::vector<Change> found = changes(before, after);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, "q1_error_versus_k");
}

}   // namespace
}   // namespace meshfolio::report
