#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page/view_blocks.h"

namespace meshfolio::report {
namespace {

using nlohmann::json;

json view_of(const Table& table, std::size_t rows = 200) {
    Document document;
    document.sections.resize(1);
    document.sections[0].id = "q1";
    document.sections[0].blocks = {table};
    ViewOptions options;
    options.table_rows = rows;
    const Numbering numbering(document, {});
    return table_view(table, {{}, numbering, {}, options});
}

Table column(std::vector<Cell> cells, Column::Best best = Column::Best::none, int digits = 3) {
    Table table{"t", "", {{"x", "", digits, best}}, {}};
    for (Cell& cell : cells) table.rows.push_back({std::move(cell)});
    return table;
}

std::vector<std::string> numbers_of(const json& view) {
    std::vector<std::string> numbers;
    for (const json& row : view["rows"]) numbers.push_back(row["cells"][0]["number"]);
    return numbers;
}

std::string marked(const json& view) {
    std::string marks;
    for (const json& row : view["rows"]) marks += row["cells"][0]["is_best"] == true ? '*' : '-';
    return marks;
}

using Words = std::vector<std::string>;

TEST(ViewTable, CountsAreShownWholeAndMeasuresWithTheirDigits) {
    EXPECT_EQ(numbers_of(view_of(column({642.0, 10242.0, 3.0}))), (Words{"642", "10\u202f242", "3"}));
    EXPECT_EQ(numbers_of(view_of(column({642.0, 0.5}))), (Words{"642", "0.500"}));
}

TEST(ViewTable, UndefinedIsADashAndNeverZero) {
    EXPECT_EQ(numbers_of(view_of(column({1.5, Cell(), std::nan("")}))), (Words{"1.50", "–", "–"}));
}

TEST(ViewTable, IfOneNumberHasAPowerOfTenAllFarFromOneHave) {
    EXPECT_EQ(numbers_of(view_of(column({3.59e-5, 1.795e-4, 0.5}))), (Words{"3.59\u202f×\u202f10⁻⁵", "1.79\u202f×\u202f10⁻⁴", "0.500"}));
    // A number that is shorter without a power of ten is written without one, as in the columns beside it.
    EXPECT_EQ(numbers_of(view_of(column({1.5e7, 1208.4, 0.5}))), (Words{"1.50\u202f×\u202f10⁷", "1208", "0.500"}));
}

TEST(ViewTable, HeatRisesWithTheLogarithmBetweenItsLimits) {
    Table table = column({1e-9, 0.1, 1.0, std::sqrt(1e3), 1e3, 1e6, Cell()});
    table.columns[0].heat = {1, 1e3};
    const json view = view_of(table);
    std::string heats;
    for (const json& row : view["rows"]) {
        const json& cell = row["cells"][0];
        heats += cell["has_heat"] == true ? cell["heat"].get<std::string>() : "-";
    }
    EXPECT_EQ(heats, "000366-");
    EXPECT_EQ(view_of(column({1.0}))["rows"][0]["cells"][0]["has_heat"], false);
}

// An order of −0.77 ± 0.6 has no second decimal.
TEST(ViewTable, OrdersHaveOneDecimal) {
    Table orders = column({-0.77, 0.98, -1.14, 0.04, -0.04, 12.31, Cell()});
    orders.columns[0].rounding = Column::Rounding::tenths;
    EXPECT_EQ(numbers_of(view_of(orders)), (Words{"\u22120.8", "1.0", "\u22121.1", "0", "0", "12.3", "–"}));
}

// Right-aligned with these figure spaces all points stand under each other.
TEST(ViewTable, PaddingPutsPointsUnderEachOther) {
    const json view = view_of(column({0.0352, 28.1, 120.0, Cell()}));
    Words paddings;
    for (const json& row : view["rows"]) paddings.push_back(row["cells"][0]["padding"]);
    const std::string figure = "\u2007", point = "\u2008";
    EXPECT_EQ(numbers_of(view), (Words{"0.0352", "28.1", "120", "–"}));
    EXPECT_EQ(paddings,
              (Words{"", figure + figure + figure, point + figure + figure + figure + figure, point + figure + figure + figure + figure}));
}

TEST(ViewTable, BestIsMarkedWhereThereIsAChoice) {
    using enum Column::Best;
    EXPECT_EQ(marked(view_of(column({3.0, 1.0, 2.0, std::nan(""), 1.0}, smallest))), "-*--*");
    EXPECT_EQ(marked(view_of(column({3.0, 1.0, Cell()}, largest))), "*--");
    EXPECT_EQ(marked(view_of(column({3.0, 1.0}))), "--");
    EXPECT_EQ(marked(view_of(column({2.0, 2.0}, smallest))), "--");
    EXPECT_EQ(marked(view_of(column({2.0}, smallest))), "-");
}

TEST(ViewTable, LongTablesShowTheirEnds) {
    std::vector<Cell> cells;
    for (int i = 0; i < 100; ++i) cells.emplace_back(double(i));
    const json rows = view_of(column(cells), 5)["rows"];
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[2]["cells"][0]["number"], "2");
    EXPECT_EQ(rows[3]["is_gap"], true);
    EXPECT_EQ(rows[3]["left_out"], "95 rows");
    EXPECT_EQ(view_of(column(cells), 99)["rows"][50]["left_out"], "1 row");
    EXPECT_EQ(rows[4]["cells"][0]["number"], "98");
    EXPECT_EQ(view_of(column(cells), 100)["rows"].size(), 100u);
}

// Scripts sort by the number itself, not by its printed digits.
TEST(ViewTable, ValuesKeepEveryDigit) {
    Table table = column({1.0 / 3, 1e-7, Cell(), std::nan("")});
    table.sortable = true;
    const json view = view_of(table);
    EXPECT_EQ(view["is_sortable"], true);
    Words values;
    for (const json& row : view["rows"]) values.push_back(row["cells"][0]["has_value"] == true ? row["cells"][0]["value"] : "none");
    EXPECT_EQ(values, (Words{"0.3333333333333333", "1e-07", "none", "none"}));
}

TEST(ViewTable, ATableWithRowsLeftOutIsNotSorted) {
    Table table = column({1.0, 2.0, 3.0, 4.0});
    table.sortable = true;
    EXPECT_EQ(view_of(table, 4)["is_sortable"], true);
    EXPECT_EQ(view_of(table, 3)["is_sortable"], false);
    EXPECT_EQ(view_of(column({1.0}))["is_sortable"], false) << "unless asked for";
}

TEST(ViewTable, AReferenceIsALinkWithTheNameOfItsTarget) {
    Table table{"t", "", {{"see"}}, {{std::string("t")}}};
    table.columns[0].reference = table.columns[0].filter = true;
    const json view = view_of(table);
    EXPECT_EQ(view["columns"][0]["is_filter"], true);
    const json& run = view["rows"][0]["cells"][0]["runs"][0];
    EXPECT_EQ(run["is_link"], true);
    EXPECT_EQ(run["href"], "#t");
    EXPECT_EQ(run["text"], "Table 1.1");
    table.rows[0][0] = std::string("t_unknown");
    EXPECT_THROW(view_of(table), std::logic_error) << "leads nowhere";
}

}   // namespace
}   // namespace meshfolio::report
