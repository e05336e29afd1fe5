#include "geometry/linear/ldlt_analysis.h"

#include <Eigen/OrderingMethods>
#include <cmath>
#include <string>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/linear/front_tree.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

namespace {

std::vector<int> minimum_degree_order(const SparseMatrix& A) {
    if (A.rows() != A.cols() || A.rows() == 0) throw SolverError("LDLᵀ factorisation: the matrix is empty or not square");
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(A, order);
    return {order.indices().begin(), order.indices().end()};
}

void check_finite(const SparseMatrix& A) {
    for (Eigen::Index z = 0; z < A.nonZeros(); ++z)
        if (!std::isfinite(A.valuePtr()[z])) throw SolverError("LDLᵀ factorisation: the matrix has an entry that is not finite");
}

/// A pivot is what is left of a diagonal entry after the elimination. Below a few roundings of that entry its sign means nothing.
/// @throws SolverError if one is, or is not finite, or is negative where all must be positive
void check_pivots(const LdltPanels& L, const Vector& diagonal, bool definite) {
    for (Eigen::Index i = 0; i < L.pivots.size(); ++i) {
        const int row = L.order[static_cast<std::size_t>(i)];
        const double pivot = L.pivots[i], rounding = 16 * epsilon * std::abs(diagonal[row]);
        if (std::isfinite(pivot) && (definite ? pivot : std::abs(pivot)) > rounding) continue;
        throw SolverError("LDLᵀ factorisation of a " + std::to_string(L.size) + "-row matrix" +
                          (definite ? ", which is not positive definite" : "") + ": pivot " + plain_text(pivot, 3) + " at row " +
                          std::to_string(row) + ", where the diagonal is " + plain_text(diagonal[row], 3));
    }
}

LdltPanels checked_factor(const SparseMatrix& A, double sigma, const FrontTree& tree, bool definite, bool parallel) {
    check_finite(A);
    LdltPanels panels = factor_by_fronts(A, sigma, tree, parallel);
    check_pivots(panels, A.diagonal().array() - sigma, definite);
    return panels;
}

}   // namespace

LdltAnalysis::LdltAnalysis(const SparseMatrix& A) : tree_(front_tree(A, minimum_degree_order(A))) {}

double LdltAnalysis::memory() const {
    constexpr double bytes_per_entry = 14;   // of the panels, and of what fronts leave to their parents
    constexpr double bytes_per_row = 600;    // of the matrix, its sorted copy, the system and the tree
    return bytes_per_entry * static_cast<double>(entries()) + bytes_per_row * static_cast<double>(order().size());
}

LdltPanels LdltAnalysis::factor(const SparseMatrix& A, double sigma, bool parallel) const {
    LdltPanels panels = checked_factor(A, sigma, tree_, false, parallel);
    const Vector diagonal = A.diagonal().array() - sigma;
    panels.growth = (panels.pivots.array() / diagonal(panels.order).array()).abs().maxCoeff();
    return panels;
}

LdltPanels LdltAnalysis::factor_definite(const SparseMatrix& A, bool parallel) const { return checked_factor(A, 0, tree_, true, parallel); }

Inertia LdltAnalysis::count_below(const SparseMatrix& A, double sigma, bool parallel) const {
    const LdltPanels panels = factor(A, sigma, parallel);
    return {sigma, panels.negative_pivots(), shifted_backward_error(panels, sigma)};
}

}   // namespace meshfolio
