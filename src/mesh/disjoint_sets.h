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

/// Disjoint sets of the integers below n, which several threads may join at once. In the end the smallest member stands for its set.
class DisjointSets {
public:
    explicit DisjointSets(int n) { reset(n); }
    void reset(int n) {
        parent_.resize(at(n));
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        for (int above = parent_of(i); above != i;) {
            const int next = parent_of(above);
            if (next != above) parent(i).store(next, std::memory_order_relaxed);   // a shorter way, whoever writes last
            i = std::exchange(above, next);
        }
        return i;
    }
    /// @return whether they were apart
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
