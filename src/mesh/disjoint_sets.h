/// @file
/// Union and find.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/at.h"

namespace meshfolio {

/// Disjoint sets of the integers below n; the smallest member stands for its set.
class DisjointSets {
public:
    explicit DisjointSets(int n) { reset(n); }

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

private:
    std::vector<int> parent_;
};

}   // namespace meshfolio
