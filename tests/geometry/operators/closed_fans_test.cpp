#include "geometry/operators/closed_fans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace meshfolio;

namespace {

/// The corners at one vertex: `next` of each, and `previous`.
CornerBatch fan_of(int vertex, const std::vector<int>& next, const std::vector<int>& previous) {
    CornerBatch fan;
    const auto size = static_cast<int>(next.size());
    fan.resize(size, 1);
    fan.first_vertex = vertex;
    fan.ring_start = {0, size};
    std::copy(next.begin(), next.end(), fan.next.begin());
    std::copy(previous.begin(), previous.end(), fan.previous.begin());
    find_closed_fans(fan);
    return fan;
}

}   // namespace

TEST(ClosedFans, PlacesAreRanksInTheRowOfTheVertex) {
    constexpr int vertex = 20;
    for (int size = 3; size <= 8; ++size) {
        std::vector<int> next = {31, 4, 50, 12, 21, 7, 90, 19}, previous;
        next.resize(static_cast<std::size_t>(size));
        previous = next;
        std::rotate(previous.begin(), previous.begin() + 1, previous.end());
        std::vector<int> row = next;
        row.push_back(vertex);
        std::sort(row.begin(), row.end());
        const auto place = [&](int v) { return static_cast<int>(std::find(row.begin(), row.end(), v) - row.begin()); };
        const CornerBatch fan = fan_of(vertex, next, previous);
        EXPECT_EQ(fan.diagonal_place[0], place(vertex)) << size;
        for (std::size_t j = 0; j < next.size(); ++j) {
            EXPECT_EQ(fan.place_of_next[j], place(next[j])) << size;
            EXPECT_EQ(fan.place_of_previous[j], place(previous[j])) << size;
        }
    }
}

TEST(ClosedFans, OpenOnesAndThoseOfManyTrianglesAreNone) {
    EXPECT_EQ(fan_of(20, {31, 4, 50, 12}, {4, 50, 12, 60}).diagonal_place[0], CornerBatch::not_closed) << "a boundary";
    EXPECT_EQ(fan_of(20, {31, 4, 50, 31}, {4, 50, 31, 31}).diagonal_place[0], CornerBatch::not_closed) << "one neighbour twice";
    EXPECT_EQ(fan_of(20, {1, 2, 3, 4, 5, 6, 7, 8, 9}, {2, 3, 4, 5, 6, 7, 8, 9, 1}).diagonal_place[0], CornerBatch::not_closed)
        << "too many";
}
