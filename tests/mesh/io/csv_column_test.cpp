#include "mesh/io/csv_column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/errors.h"

using namespace meshfolio;

namespace {

Vector values_of(const std::string& table, const std::string& name, Eigen::Index rows) {
    return csv_column(table, "f.csv", {name}, rows).values;
}

/// Expects 1.5 and −2 in column H, and no other rows.
void expect_read(const std::string& table) {
    try {
        const Vector values = values_of(table, "H", 2);
        EXPECT_EQ(values[0], 1.5) << table;
        EXPECT_EQ(values[1], -2) << table;
    } catch (const InputError& error) {
        ADD_FAILURE() << table << error.what();
    }
}

}   // namespace

TEST(CsvColumn, HasTheRequestedNumberOfRows) {
    const std::string csv = "a,b\n1,2\n3,\n";
    EXPECT_EQ(values_of(csv, "a", 2), Vector((Vector(2) << 1, 3).finished()));
    EXPECT_TRUE(std::isnan(values_of(csv, "b", 2)[1]));
    EXPECT_THROW(values_of(csv, "a", 1), InputError);
    EXPECT_THROW(values_of(csv, "a", 3), InputError);
    EXPECT_EQ(csv_column(csv, "f.csv", {"a"}, 1, MoreRows::left_out).values, Vector::Ones(1));
}

TEST(CsvColumn, SeparatorsQuotesAndLineEndsChangeNothing) {
    const std::string mark = "\xef\xbb\xbf";
    for (const std::string table : {"K,H\n0,1.5\n0,-2\n",
                                    "K;H\n0;1.5\n0;-2\n",
                                    "K\tH\n0\t1.5\n0\t-2\n",
                                    "K H\n0 1.5\n0  -2\n",
                                    "\"K\",\"H\"\n0,1.5\n0,-2\n",
                                    "# K,H\n0,1.5\n0,-2\n",
                                    "#K H\n0 1.5\n0 -2\n",
                                    "% by Ada\nK,h\n0,1.5\n0,-2\n",
                                    "H,K,\n1.5,0,\n-2,0,\n",
                                    "H,K\n1.5,0,\n-2,0,\n",
                                    "K;H\n0;1,5\n0;-2,0\n",
                                    "\n K , H \n 0 , \"1.5\"\n\n0,-2\n\n\n",
                                    "1.5\n-2\n",
                                    "1,5\n-2,0\n",
                                    "H\n1.5\n-2\n",
                                    "# H\n1.5e0\n-2\n\n",
                                    "h,H\n0,1.5\n0,-2\n",
                                    "K,H\r0,1.5\r0,-2\r",
                                    "K,H\r\r\n0,1.5\r\r\n0,-2\r\r\n",
                                    "H\r\n\r\n1.5\r\n\r\n-2\r\n",
                                    "\"x, y\",H\n0,1.5\n0,-2\n",
                                    "H\n+1.5\n-2.\n# the end\n"}) {
        if (table == "1,5\n-2,0\n") {   // two columns, or decimal commas?
            EXPECT_THROW(values_of(table, "H", 2), InputError);
            continue;
        }
        expect_read(table);
        expect_read(mark + table);
    }
}

TEST(CsvColumn, TheFirstNameInTheHeaderIsTakenAndItsOwnCaseFirst) {
    const auto read = [](const std::string& header, const std::vector<std::string>& names) {
        return csv_column(header + "\n1,2,3\n", "f.csv", names, 1).values[0];
    };
    EXPECT_EQ(read("h,k,H", {"H"}), 3);
    EXPECT_EQ(read("h_cotan,x,H", {"H", "h_cotan"}), 3);
    EXPECT_EQ(read("h,x,h_cotan", {"H", "h_cotan"}), 3);
    EXPECT_EQ(read("x,h,y", {"H", "h_cotan"}), 2);
    EXPECT_EQ(read("H,H,y", {"H"}), 1);
    EXPECT_THROW(read("x,y,z", {"H"}), InputError);
}

TEST(CsvColumn, CellsWithoutANumberAreNan) {
    for (const std::string cell : {"", "nan", "-NaN", "-nan(ind)", "inf", "-Infinity", "NA"}) {
        EXPECT_TRUE(std::isnan(values_of("K,H\n0," + cell + "\n", "H", 1)[0])) << cell;
        EXPECT_TRUE(std::isnan(values_of("H\n1\n" + cell + "\n", "H", 2)[1])) << cell;
    }
    EXPECT_EQ(csv_column("H\n1\nnan\n-inf\ninf\n", "f.csv", {"H"}, 4).first_infinite, 4);
    EXPECT_EQ(csv_column("H\n1\nnan\n", "f.csv", {"H"}, 2).first_infinite, 0);
    EXPECT_TRUE(std::isnan(values_of("# by Ada\n\n1\n\n", "H", 3)[0]));
    EXPECT_TRUE(std::isnan(values_of("# by Ada\n\n1\n\n", "H", 3)[2]));
    for (const std::string cell : {"x", "1e400", "2e100", "1.2.3", "0x1", "1 2", "-", "(1+0j)"})
        EXPECT_THROW(values_of("H,K\n" + cell + ",0\n", "H", 1), InputError) << cell;
    for (const std::string table : {"", "\n\n", "# H\n", "H\n", "H,K\n1\n", "H,K\n1,2,3\n", "1,2\n", "x\n1\n", "H\nx\n"})
        EXPECT_THROW(values_of(table, "H", 1), InputError) << table;
}

TEST(CsvColumn, DecimalsGiveTheRoundingOfANumber) {
    const auto rounding = [](const std::string& cell) { return csv_column("H\n" + cell + "\n", "f.csv", {"H"}, 1).rounding[0]; };
    EXPECT_DOUBLE_EQ(rounding("0.001234"), 0.5e-6);
    EXPECT_DOUBLE_EQ(rounding("-1.5e-3"), 0.5e-4);
    EXPECT_DOUBLE_EQ(rounding("12"), 0.5);
    EXPECT_DOUBLE_EQ(rounding("1.E+2"), 50);
    EXPECT_EQ(rounding("nan"), 0);
}

TEST(CsvColumn, TimeIsLinearInTheBytes) {
    const std::size_t bytes = 4'000'000;   // squared, hours: ctest would end this
    const std::string many_cells = "H" + std::string(bytes, ',');
    EXPECT_EQ(values_of("K\n1" + std::string(bytes, '\n'), "K", 1000)[0], 1);
    for (const std::string& table : {many_cells, "H\n" + many_cells, "K\n" + std::string(bytes, '"'), std::string(bytes, ';')})
        EXPECT_THROW(values_of(table, "K", 1000), InputError);
}
