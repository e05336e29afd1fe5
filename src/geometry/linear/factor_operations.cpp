#include "geometry/linear/factor_operations.h"

#include "geometry/linear/elimination_tree.h"

namespace meshfolio {

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
