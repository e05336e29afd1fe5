#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

using namespace meshfolio;

TEST(Parallel, EveryIndexIsVisitedOnce) {
    for (const int n : {0, 1, block_length - 1, block_length, block_length + 1, 5 * block_length + 7}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(n));
        for_each_index(n, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
        EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& count) { return count == 1; })) << n;
    }
}

TEST(Parallel, BlocksReturnInOrder) {
    const int n = 9 * block_length + 1;
    int next = 0;
    for (const auto& [range] : per_block(n, [](int begin, int end) { return std::pair(begin, end); })) {
        EXPECT_EQ(range.first, next);
        next = range.second;
    }
    EXPECT_EQ(next, n);
}

TEST(Parallel, AllOfRangeFindsASingleExceptionAnywhere) {
    const int n = 3 * block_length;
    EXPECT_TRUE(all_of_range(n, [](int) { return true; }));
    for (const int odd : {0, block_length, n - 1}) EXPECT_FALSE(all_of_range(n, [&](int i) { return i != odd; }));
}

// Terms of very different size: added in another order they would have another sum.
TEST(Parallel, OrderedSumsEqualThoseOfOneProcessor) {
    const auto term = [](int i) { return std::pow(-1.7, i % 60) / (1 + i); };
    for (const int n : {0, 1, 1000, 40 * block_length + 5}) {
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += term(i);
        EXPECT_EQ(ordered_sum(n, term), sum) << n;
    }
}
