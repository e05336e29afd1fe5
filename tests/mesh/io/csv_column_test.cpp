#include "mesh/io/csv_column.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"

using namespace meshfolio;

TEST(CsvColumn, HasAsManyRowsAsAreAskedForOrAsThereAre) {
    const std::string csv = "a,b\n1,2\n3,\n";
    EXPECT_EQ(csv_column(csv, "f.csv", "a"), Vector((Vector(2) << 1, 3).finished()));
    EXPECT_TRUE(std::isnan(csv_column(csv, "f.csv", "b", {.rows = 2})[1]));
    EXPECT_THROW(csv_column(csv, "f.csv", "a", {.rows = 1}), InputError);
    EXPECT_THROW(csv_column(csv, "f.csv", "a", {.rows = 3}), InputError);
    EXPECT_EQ(csv_header(csv, "f.csv"), (std::vector<std::string>{"a", "b"}));
}

TEST(CsvColumn, BlanksAndNanAreTakenWhereThatIsAskedFor) {
    const std::string csv = " a , b\r\n 1 , NaN \r\n2,3\r\n";
    const CsvRules lenient{.lenient = true};
    EXPECT_EQ(csv_column(csv, "f.csv", "a", lenient), Vector((Vector(2) << 1, 2).finished()));
    EXPECT_TRUE(std::isnan(csv_column(csv, "f.csv", "b", lenient)[0]));
    EXPECT_THROW(csv_column(csv, "f.csv", "a"), InputError);
    EXPECT_THROW(csv_column("a\nnan\n", "f.csv", "a"), InputError);
    EXPECT_THROW(csv_column("a\ninf\n", "f.csv", "a", lenient), InputError);
}
