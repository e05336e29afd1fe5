#include "questions/core/section_tools.h"

#include <gtest/gtest.h>

using namespace meshfolio;

TEST(ValueLists, AValueNamedTwiceIsOne) {
    EXPECT_EQ(each_once(std::vector{3, 1, 3, 2, 1}), (std::vector{1, 2, 3}));
    EXPECT_EQ(each_once(std::vector<double>{}), std::vector<double>{});
}

TEST(ValueLists, TheLastGivenCounts) {
    EXPECT_EQ(last_or({}, 7), 7);
    EXPECT_EQ(last_or({5, 3}, 7), 3);
}

TEST(ValueLists, RisesAreBetweenNeighbours) {
    const std::vector<double> values{5, 2, 3, 1, 1.5};
    EXPECT_EQ(largest_rise(values), 1);
    EXPECT_EQ(largest_rise(std::vector<double>(values.rbegin(), values.rend())), 3);
    EXPECT_EQ(largest_rise(std::vector<double>{3, 2, 1}), 0);
    EXPECT_EQ(largest_rise(std::vector<double>{1}), 0);
    EXPECT_EQ(largest_rise(std::vector<double>{}), 0);
}
