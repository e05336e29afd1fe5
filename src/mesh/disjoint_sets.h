/// @file
/// Union and find.
#pragma once

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>
#include <vector>

#include "base/at.h"

namespace meshfolio {

/// Disjoint sets of the integers below n; several threads may join them at once. The smallest member represents its set in the end.
class DisjointSets {
public:
    explicit DisjointSets(int n) : parent_(at(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
    /// Returns the member that represents the set of i.
    int find(int i) {
        for (int above = parent_of(i); above != i;) {
            const int next = parent_of(above);
            if (next != above) parent(i).store(next, std::memory_order_relaxed);   // shortens the way
            i = std::exchange(above, next);
        }
        return i;
    }
    /// Joins the sets of i and j. Returns true if they were different.
    bool join(int i, int j) {
        if (parent_of(i) == parent_of(j)) return false;
        for (int a = find(i), b = find(j); a != b; a = find(a), b = find(b)) {
            int larger = std::max(a, b);
            if (parent(larger).compare_exchange_strong(larger, std::min(a, b), std::memory_order_relaxed)) return true;
        }
        return false;
    }

private:
    std::atomic_ref<int> parent(int i) { return std::atomic_ref(parent_[at(i)]); }
    int parent_of(int i) { return parent(i).load(std::memory_order_relaxed); }

    std::vector<int> parent_;
};

}   // namespace meshfolio
