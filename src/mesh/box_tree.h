/// @file
/// Finds axis-aligned boxes among many.
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "base/at.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

/// A binary tree over boxes, split at the median of their centres along the longest side.
class BoxTree {
public:
    explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        if (!boxes_.empty()) build(0, 0, order_.size());
    }

    /// Calls found(i) for each box i that passes wanted(box), until found returns false. A box around others must pass where one of them
    /// does.
    template <class Wanted, class Found>
    bool visit(const Wanted& wanted, const Found& found) const {
        return boxes_.empty() || visit(0, 0, order_.size(), wanted, found);
    }

private:
    static constexpr std::size_t leaf_size = 4;

    void build(std::size_t node, std::size_t begin, std::size_t end) {
        Box around = boxes_[at(order_[begin])];
        for (std::size_t i = begin; i < end; ++i) {
            around.low = around.low.cwiseMin(boxes_[at(order_[i])].low);
            around.high = around.high.cwiseMax(boxes_[at(order_[i])].high);
        }
        if (node >= around_.size()) around_.resize(2 * node + 1);
        around_[node] = around;
        if (end - begin <= leaf_size) return;
        int axis = 0;
        around.extent().maxCoeff(&axis);
        const auto place = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        const std::size_t middle = begin + (end - begin) / 2;
        std::nth_element(place(begin), place(middle), place(end), [&](int i, int j) {
            const double x = boxes_[at(i)].centre()[axis], y = boxes_[at(j)].centre()[axis];
            return std::pair(x, i) < std::pair(y, j);
        });
        build(2 * node + 1, begin, middle);
        build(2 * node + 2, middle, end);
    }

    template <class Wanted, class Found>
    bool visit(std::size_t node, std::size_t begin, std::size_t end, const Wanted& wanted, const Found& found) const {
        if (!wanted(around_[node])) return true;
        if (end - begin > leaf_size) {
            const std::size_t middle = begin + (end - begin) / 2;
            return visit(2 * node + 1, begin, middle, wanted, found) && visit(2 * node + 2, middle, end, wanted, found);
        }
        for (std::size_t i = begin; i < end; ++i)
            if (wanted(boxes_[at(order_[i])]) && !found(order_[i])) return false;
        return true;
    }

    std::vector<Box> boxes_, around_;   // `around_` as a heap: node k is around 2k + 1 and 2k + 2
    std::vector<int> order_;
};

}   // namespace meshfolio
