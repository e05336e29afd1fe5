#include "questions/bench/spectral_uses.h"

#include "geometry/linear/sparse_factor.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/spectral_mistakes.h"
#include "geometry/spectrum/spectral_reconstruction.h"

namespace meshfolio {

namespace {

/// The two operators' modes at one k, four ways.
MistakeErrors mistakes_at(const SpectralStudy& study, const Spectrum& edge_normalised, const LaplaceBeltrami& other, int k) {
    const Positions& X = study.mesh().X;
    const Vector& M = study.laplacian.M;
    MistakeErrors row;
    row.k = k;
    row.right = vertex_rms(X, reconstruct(study.spectrum, M, X, k));
    row.unmapped = vertex_rms(X, reconstruct_unmapped(study.spectrum, M, X, k));
    row.unweighted = vertex_rms(X, reconstruct_unweighted(study.spectrum, M, X, k));
    const bool known = edge_normalised.eigenvalues.size() >= k;
    row.edge_normalised = known ? vertex_rms(X, reconstruct(edge_normalised, other.M, X, k)) : undefined;
    return row;
}

/// None where negative or missing weights leave the operator without a spectrum.
Spectrum modes_if_any(const LaplaceBeltrami& laplacian, int k) try {
    return smallest_eigenpairs(laplacian, k);
} catch (const SolverError&) {
    return {};
}

}   // namespace

std::vector<MistakeErrors> mistake_study(const SpectralStudy& study, bool quick) {
    const int most = std::min(study.modes(), study.spectrum.dense ? 150 : quick ? 30 : 60);
    std::vector<int> counts;
    for (const int k : {5, 10, 15, 30, 60, 150}) counts.push_back(std::min(k, most));
    const LaplaceBeltrami other = laplace_operator(study.mesh(), OperatorKind::edge_normalised);
    const Spectrum edge_normalised = modes_if_any(other, most);
    std::vector<MistakeErrors> errors;
    for (const int k : each_once(counts)) errors.push_back(mistakes_at(study, edge_normalised, other, k));
    return errors;
}

ModeCost mode_cost(int k, double n, double factor_entries) {
    return {k, 4 * factor_entries * k, 2 * n * k * k, 12 * n * k, 8 * n * k / 1048576};
}

/// How full a factor is depends on the pattern alone: that of −C with entries for which no needle can spoil the factorisation.
double factor_entries(const SpectralStudy& study) {
    SparseMatrix A = operator_with_mass(study.laplacian).A;
    A.makeCompressed();
    for (int j = 0; j < A.cols(); ++j) {
        const auto entries = static_cast<double>(A.outerIndexPtr()[j + 1] - A.outerIndexPtr()[j]);
        for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) entry.valueRef() = entry.row() == j ? entries : -1;
    }
    return static_cast<double>(SparseFactor::cholesky(A).nonzeros());
}

}   // namespace meshfolio
