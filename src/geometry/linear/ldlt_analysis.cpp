#include "geometry/linear/ldlt_analysis.h"

#include <cmath>
#include <limits>

#include "geometry/linear/factor_implementation.h"
#include "geometry/linear/front_elimination.h"
#include "geometry/linear/ldlt_rounding.h"

namespace meshfolio {

LdltAnalysis::LdltAnalysis(const SparseMatrix& A, FactorLibrary library)
    : A_(A), tree_(front_tree(A, analysed(A, FactorKind::ldlt, library)->order())) {
    check_finite(A, FactorKind::ldlt);
}

LdltPanels LdltAnalysis::factor(double sigma, bool parallel) const {
    LdltPanels panels = factor_by_fronts(A_, sigma, tree_, parallel);
    Vector pivots(panels.size);   // by the rows of the matrix
    pivots(panels.order) = panels.pivots;
    const Vector diagonal = A_.diagonal().array() - sigma;
    check_pivots(pivots, diagonal, FactorKind::ldlt);
    panels.delta = backward_error(panels, Vector::Ones(panels.size), 1) + std::numeric_limits<double>::epsilon() * std::abs(sigma);
    panels.growth = (pivots.array() / diagonal.array()).abs().maxCoeff();
    return panels;
}

Inertia LdltAnalysis::count_below(double sigma, bool parallel) const {
    const LdltPanels panels = factor(sigma, parallel);
    return {sigma, panels.negative_pivots(), panels.delta};
}

}   // namespace meshfolio
