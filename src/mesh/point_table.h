/// @file
/// Points recognised by their exact value.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/at.h"

namespace meshfolio {

/// Numbers points from 0 in the order of their first appearance; equal coordinates (−0 equals 0) get the same number.
/// Open addressing; nothing depends on the slot of a point in the table.
class PointTable {
public:
    explicit PointTable(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 2), -1) { points_.reserve(expected); }

    /// Returns the number of a point equal to this one, from 0; a new point is added and gets the next number. At most the expected number
    /// of points may be added.
    int number_of(std::array<double, 3> point) {
        for (double& x : point) x += 0.0;   // −0 becomes 0
        std::size_t slot = hash(point) & (slots_.size() - 1);
        while (slots_[slot] >= 0 && points_[at(slots_[slot])] != point) slot = (slot + 1) & (slots_.size() - 1);
        if (slots_[slot] < 0) {
            slots_[slot] = static_cast<int>(points_.size());
            points_.push_back(point);
        }
        return slots_[slot];
    }

    const std::vector<std::array<double, 3>>& points() const { return points_; }

private:
    /// Multiplies and folds the bits of each coordinate (finaliser of MurmurHash3).
    static std::size_t hash(const std::array<double, 3>& point) {
        std::uint64_t h = 0;
        for (const double x : point) {
            h ^= std::bit_cast<std::uint64_t>(x);
            h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
            h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
            h ^= h >> 33;
        }
        return h;
    }

    std::vector<int> slots_;
    std::vector<std::array<double, 3>> points_;
};

}   // namespace meshfolio
