#include "geometry/linear/cholesky_analysis.h"

#include <string>

#include "base/errors.h"
#include "geometry/linear/factor_implementation.h"

namespace meshfolio {

namespace {

#ifdef MESHFOLIO_WITH_CHOLMOD
constexpr bool supernodes_known = true;
#else
constexpr bool supernodes_known = false;
#endif

bool by_supernodes(Eigen::Index rows, FactorForm form, FactorLibrary library) {
    if (!supernodes_known || library == FactorLibrary::eigen || form == FactorForm::simplicial) return false;
    return form == FactorForm::supernodal || rows >= supernodal_from;
}

}   // namespace

CholeskyAnalysis::CholeskyAnalysis(const SparseMatrix& A, FactorForm form, FactorLibrary library) {
    const bool supernodal = by_supernodes(A.rows(), form, library);
    symbolic_ = analysed(A, supernodal ? FactorKind::cholesky : FactorKind::ldlt, library, supernodal);
}
CholeskyAnalysis::~CholeskyAnalysis() = default;

std::vector<int> CholeskyAnalysis::order() const { return symbolic_->order(); }

long long CholeskyAnalysis::nonzeros() const { return symbolic_->nonzeros(); }

double CholeskyAnalysis::memory() const {
    constexpr double bytes_per_entry = 12 + 10;   // of the library's factor, and of the panels made from it: numbers and rows
    constexpr double bytes_per_row = 600;         // of the matrix, its sorted copy, the system and the library's workspace
    return bytes_per_entry * static_cast<double>(nonzeros()) + bytes_per_row * static_cast<double>(symbolic_->rows);
}

LdltPanels CholeskyAnalysis::factor(const SparseMatrix& A) const {
    const auto L = symbolic_->analysed_copy(A);
    factorize_checked(*L, A);
    if (L->negative > 0) {
        throw SolverError("factorisation of a " + std::to_string(A.rows()) + "-row matrix: it is not positive definite, " +
                          std::to_string(L->negative) + " of its eigenvalues are negative");
    }
    return panels_of(*L);
}

}   // namespace meshfolio
