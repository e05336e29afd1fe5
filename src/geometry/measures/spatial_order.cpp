#include "geometry/measures/spatial_order.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "geometry/linear/sparse_factor.h"

namespace meshfolio {
namespace {

constexpr int bits = 21;

/// Returns the bits of `cell` with two zeros between each and the next.
std::uint64_t spread(std::uint64_t cell) {
    cell = (cell | cell << 32) & 0x1f00000000ffff;
    cell = (cell | cell << 16) & 0x1f0000ff0000ff;
    cell = (cell | cell << 8) & 0x100f00f00f00f00f;
    cell = (cell | cell << 4) & 0x10c30c30c30c30c3;
    return (cell | cell << 2) & 0x1249249249249249;
}

}   // namespace

std::vector<int> morton_order(const Positions& X) {
    const int n = static_cast<int>(X.rows());
    if (n == 0) return {};
    const Eigen::RowVector3d low = X.colwise().minCoeff();
    const double side = (X.colwise().maxCoeff() - low).maxCoeff();
    const double cells = side > 0 ? ((1 << bits) - 1) / side : 0;
    std::vector<std::pair<std::uint64_t, int>> keyed(at(n));
    for_each_index(n, [&](int i) {
        const Eigen::RowVector3d cell = (X.row(i) - low) * cells;
        const auto along = [&](int c) { return spread(static_cast<std::uint64_t>(cell[c])) << c; };
        keyed[at(i)] = {along(0) | along(1) | along(2), i};
    });
    std::sort(keyed.begin(), keyed.end());
    std::vector<int> order(keyed.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = keyed[i].second;
    return order;
}

OperatorWithMass reordered(const OperatorWithMass& whole, const std::vector<int>& order) {
    OperatorWithMass sorted{in_order(whole.A, order), whole.M(order), whole.vertex, whole.all_vertices, whole.copies};
    for (std::size_t i = 0; i < order.size(); ++i) sorted.vertex[i] = whole.vertex[at(order[i])];
    return sorted;
}

}   // namespace meshfolio
