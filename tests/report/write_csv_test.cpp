#include <gtest/gtest.h>

#include <cmath>

#include "report/escape.h"
#include "report/sample_document.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

/// A reader of RFC 4180, written apart from the writer.
std::vector<std::vector<std::string>> parsed(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> row(1);
    bool quoted = false;
    for (std::size_t i = 0; i < csv.size(); ++i) {
        const char c = csv[i];
        if (quoted) {
            if (c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
                row.back() += csv[++i];
            } else if (c == '"') {
                quoted = false;
            } else {
                row.back() += c;
            }
        } else if (c == '"') {
            quoted = true;
        } else if (c == ',') {
            row.emplace_back();
        } else if (c == '\n') {
            rows.push_back(row);
            row.assign(1, "");
        } else {
            row.back() += c;
        }
    }
    EXPECT_FALSE(quoted);
    return rows;
}

TEST(WriteCsv, NumbersReadBackExactlyAndUndefinedIsEmpty) {
    const double x = 0.1 + 0.2;
    const Table table{"t", "", {{"a", "1/length"}, {"b"}}, {{x, std::string("s")}, {Cell(), std::nan("")}, {-1e-300, INFINITY}}};
    const auto rows = parsed(write_csv(table));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0], (std::vector<std::string>{"a [1/length]", "b"}));
    EXPECT_EQ(std::stod(rows[1][0]), x);
    EXPECT_EQ(rows[2], (std::vector<std::string>{"", ""}));
    EXPECT_EQ(std::stod(rows[3][0]), -1e-300);
    EXPECT_EQ(rows[3][1], "");
}

TEST(WriteCsv, AnyTextIsReadBackFromOneLine) {
    const Table table{
        "t", "", {{"a,\"b\"\nc"}, {"x"}}, {{hostile, std::string("plain")}, {std::string("\x1b\u202e\0 \u200f", 9), std::string("é")}}};
    const auto rows = parsed(write_csv(table));
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].front(), "a,\"b\" c");
    EXPECT_EQ(rows[1].back(), "plain");
    EXPECT_EQ(rows[2], (std::vector<std::string>{"\\x1b\\xe2\\x80\\xae\\x00 \\xe2\\x80\\x8f", "é"}));
}

/// The cells that programs set to any separator make of a text, without the blanks and quotes that they skip.
std::vector<std::string> cells_of(const std::string& text) {
    std::vector<std::string> cells(1);
    for (const char c : text) {
        if (std::string(",;|\t\r\n").find(c) != std::string::npos) cells.emplace_back();
        else if (!cells.back().empty() || (c != ' ' && c != '"')) cells.back() += c;
    }
    return cells;
}

TEST(WriteCsv, NoCellIsAFormulaWhateverTheSeparator) {
    for (const std::string before : {"", " ", "\t", "\r", "\n", "\"", "a;", "a,", "a; ", "a\t", "a\n", "a,\"", "1;2;", "a|", "a;\" "}) {
        for (const std::string sign : {"=", "+", "-", "@", "\uFF1D"}) {
            const std::string text = before + sign + "cmd|'/c calc'!A0";
            const Plot plot{.x_label = text, .y_label = "y", .series = {{text, {1}, {2}, {}, {}}}};
            for (const std::string& csv : {write_csv(Table{"t", "", {{text}}, {{text}}}), write_csv(table_of(plot))}) {
                for (const auto& row : parsed(csv)) {
                    for (const std::string& field : row)
                        for (const std::string& cell : cells_of(field)) EXPECT_FALSE(cell.starts_with(sign)) << csv;
                }
            }
        }
    }
    const Table numbers{"t", "", {{"a"}, {"b"}, {"c"}, {"d"}}, {{-3.5, std::string("-3.5"), std::string("+1e-7"), std::string("1;-2")}}};
    EXPECT_EQ(write_csv(numbers), "a,b,c,d\n-3.5,-3.5,+1e-7,1;-2\n");
}

TEST(WriteCsv, ShortRowsAreFilledUp) {
    const Table table{"t", "", {{"a"}, {"b"}}, {{1.0}}};
    EXPECT_EQ(write_csv(table), "a,b\n1,\n");
}

TEST(WriteCsv, APlotHasARowForEachPoint) {
    Plot plot;
    plot.x_label = "k";
    plot.y_label = "error, rms [%]";
    plot.series = {{"one", {1, 2}, {3, std::nan("")}, {2.5, 4}, {3.5, 6}}, {"two", {5}, {6}, {}, {}}};
    const auto rows = parsed(write_csv(table_of(plot)));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0], (std::vector<std::string>{"series", "k", "error, rms [%]", "low", "high"}));
    EXPECT_EQ(rows[1], (std::vector<std::string>{"one", "1", "3", "2.5", "3.5"}));
    EXPECT_EQ(rows[2], (std::vector<std::string>{"one", "2", "", "4", "6"}));
    EXPECT_EQ(rows[3], (std::vector<std::string>{"two", "5", "6", "", ""}));
}

TEST(WriteCsv, ASeriesSaysItsPanel) {
    Plot plot{.x_label = "k", .y_label = "error"};
    plot.series = {{"one", {1}, {3}, {}, {}}, {"two", {5}, {6}, {}, {}}};
    plot.series[0].panel = "sphere, fine";
    EXPECT_EQ(write_csv(table_of(plot)), "panel,series,k,error\n\"sphere, fine\",one,1,3\n,two,5,6\n");
}

TEST(WriteCsv, AMapHasARowForEachCellAndThenItsLines) {
    Map map;
    map.x_label = "λ, relative";
    map.y_label = "t";
    map.value_label = "error [%]";
    map.x = {0.1, 0.2, 0.4};
    map.y = {1, 10};
    map.panels = {{"explicit", {1, 2, 3, 4, 5, std::nan("")}, {{"limit", {0.3, 0.3}, {1, 10}}}}, {"implicit", {6, 7, 8, 9, 10, 11}}};
    const auto rows = parsed(write_csv(table_of(map)));
    ASSERT_EQ(rows.size(), 1u + 6 + 2 + 6);
    EXPECT_EQ(rows[0], (std::vector<std::string>{"panel", "series", "λ, relative", "t", "error [%]"}));
    EXPECT_EQ(rows[2], (std::vector<std::string>{"explicit", "cells", "0.2", "1", "2"}));
    EXPECT_EQ(rows[4], (std::vector<std::string>{"explicit", "cells", "0.1", "10", "4"}));
    EXPECT_EQ(rows[6], (std::vector<std::string>{"explicit", "cells", "0.4", "10", ""}));
    EXPECT_EQ(rows[8], (std::vector<std::string>{"explicit", "limit", "0.3", "10", ""}));
    EXPECT_EQ(rows[9], (std::vector<std::string>{"implicit", "cells", "0.1", "1", "6"}));
}

}   // namespace
}   // namespace meshfolio::report
