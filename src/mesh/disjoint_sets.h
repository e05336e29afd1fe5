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

/// Disjoint sets of the integers below n; the smallest member stands for its set.
class DisjointSets {
public:
    DisjointSets() = default;
    /// Every i in one set with parent[i], which must not be larger than i.
    explicit DisjointSets(std::vector<int> parent) : parent_(std::move(parent)) { flatten(); }

    void reset(int n) {
        parent_.resize(at(n));
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
        return i;
    }
    bool join(int i, int j) {
        const int a = find(i);
        const int b = find(j);
        parent_[at(std::max(a, b))] = std::min(a, b);
        return a != b;
    }

    /// The same, while other threads do so too. The sets do not depend on who comes first: always the larger root is hung on the
    /// smaller one, and only while it still is a root.
    void join_concurrently(int i, int j) {
        for (;;) {
            int larger = find_concurrently(i);
            int smaller = find_concurrently(j);
            if (larger == smaller) return;
            if (larger < smaller) std::swap(larger, smaller);
            int root = larger;
            if (parent(larger).compare_exchange_strong(root, smaller, std::memory_order_relaxed)) return;
        }
    }

    /// Makes `found` valid until the next join: parents are smaller, so the one of a parent is already right.
    void flatten() {
        for (int& parent : parent_) parent = parent_[at(parent)];
    }
    int found(int i) const { return parent_[at(i)]; }

private:
    std::atomic_ref<int> parent(int i) { return std::atomic_ref<int>(parent_[at(i)]); }
    int find_concurrently(int i) {
        for (;;) {
            const int up = parent(i).load(std::memory_order_relaxed);
            if (up == i) return i;
            const int further_up = parent(up).load(std::memory_order_relaxed);
            if (further_up != up) parent(i).store(further_up, std::memory_order_relaxed);
            i = further_up;
        }
    }

    std::vector<int> parent_;
};

}   // namespace meshfolio
