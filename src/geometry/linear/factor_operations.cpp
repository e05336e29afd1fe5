#include "geometry/linear/factor_operations.h"

#include "base/errors.h"

namespace meshfolio {

std::vector<int> places_of(const std::vector<int>& order, Eigen::Index rows) {
    std::vector<int> place(static_cast<std::size_t>(rows), -1);
    bool valid = order.size() == place.size();
    for (std::size_t i = 0; valid && i < order.size(); ++i) {
        valid = order[i] >= 0 && order[i] < rows && place[static_cast<std::size_t>(order[i])] < 0;
        if (valid) place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    }
    if (!valid) throw MeshError("elimination tree: the order is no permutation of " + std::to_string(rows) + " rows");
    return place;
}

/// Row k has an entry in every column on the way up the tree from its own entries to k.
EliminationTree elimination_tree(const SparseMatrix& A, const std::vector<int>& order) {
    const std::vector<int> place = places_of(order, A.rows());
    const std::size_t n = order.size();
    EliminationTree tree{std::vector<int>(n, -1), std::vector<int>(n, 0)};
    std::vector<int> seen(n, -1);
    for (std::size_t k = 0; k < n; ++k) {
        const int row = static_cast<int>(k);
        seen[k] = row;
        for (SparseMatrix::InnerIterator entry(A, order[k]); entry; ++entry) {
            std::size_t i = static_cast<std::size_t>(place[static_cast<std::size_t>(entry.index())]);
            if (i >= k) continue;
            for (; seen[i] != row; i = static_cast<std::size_t>(tree.parent[i])) {
                if (tree.parent[i] < 0) tree.parent[i] = row;
                ++tree.count[i];
                seen[i] = row;
            }
        }
    }
    return tree;
}

FactorOperations factor_operations(const SparseMatrix& A, const std::vector<int>& order) {
    FactorOperations operations;
    for (const int count : elimination_tree(A, order).count) {
        const double c = count;
        operations.nonzeros += count + 1;
        operations.factorisation += 0.5 * c * (c + 1) + c;   // the update of what is left, symmetric, and the division by the pivot
        operations.solve += 2 * c + 1;
    }
    return operations;
}

}   // namespace meshfolio
