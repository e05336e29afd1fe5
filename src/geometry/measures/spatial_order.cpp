#include "geometry/measures/spatial_order.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"

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
    const int n = whole.size();
    OperatorWithMass sorted;
    sorted.all_vertices = whole.all_vertices;
    sorted.copies = whole.copies;
    sorted.M = whole.M(order);
    sorted.vertex.resize(order.size());
    std::vector<int> place(order.size());
    for (int i = 0; i < n; ++i) {
        const std::size_t old = at(order[at(i)]);
        sorted.vertex[at(i)] = whole.vertex[old];
        place[old] = i;
    }
    sorted.A.resize(n, n);
    sorted.A.resizeNonZeros(whole.A.nonZeros());
    int* const start = sorted.A.outerIndexPtr();
    for (int j = 0; j < n; ++j) {
        const int old = order[at(j)];
        start[j + 1] = start[j] + whole.A.outerIndexPtr()[old + 1] - whole.A.outerIndexPtr()[old];
    }
    for_blocks(n, [&](int, int begin, int end) {
        std::vector<std::pair<int, double>> column;
        for (int j = begin; j < end; ++j) {
            column.clear();
            for (SparseMatrix::InnerIterator entry(whole.A, order[at(j)]); entry; ++entry)
                column.emplace_back(place[std::size_t(entry.row())], entry.value());
            std::sort(column.begin(), column.end());
            for (std::size_t k = 0; k < column.size(); ++k) {
                sorted.A.innerIndexPtr()[at(start[j]) + k] = column[k].first;
                sorted.A.valuePtr()[at(start[j]) + k] = column[k].second;
            }
        }
    });
    return sorted;
}

}   // namespace meshfolio
