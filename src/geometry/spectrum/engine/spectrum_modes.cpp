#include "geometry/spectrum/engine/spectrum_modes.h"

#include "base/errors.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/engine/spectrum_slices.h"

namespace meshfolio {
namespace {

/// Returns the pair of the constant, μ = 0, and the given pairs after it.
SymmetricPairs with_constant(const Vector& M, const Vector& mu, const Eigen::Ref<const DenseMatrix>& Y) {
    SymmetricPairs all{Vector(mu.size() + 1), DenseMatrix(M.size(), mu.size() + 1)};
    all.mu << 0, mu;
    all.Y << M.cwiseSqrt().normalized(), Y;
    return all;
}

Modes dense_modes(const SparseMatrix& A, const Vector& M, int k) {
    const SymmetricPairs all = dense_pairs(A, M);
    return {part_of(all, 0, k), gap_behind(all.mu, k).middle(), true};
}

}   // namespace

Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs) {
    Vector residuals(pairs.count());
    for_each_task(static_cast<std::size_t>(pairs.count()), [&](std::size_t task) {
        const auto j = static_cast<Eigen::Index>(task);
        const double mu = pairs.mu[j];
        Vector r = B * pairs.Y.col(j);
        r -= mu * pairs.Y.col(j);
        const double size = mu > 0 ? mu * root_mass.cwiseProduct(pairs.Y.col(j)).norm() : 1;
        residuals[j] = root_mass.cwiseProduct(r).norm() / size;
    });
    return residuals;
}

Gap gap_behind(const Vector& mu, int k) {
    constexpr double clear = 1e-5;
    for (Eigen::Index i = k; i < mu.size(); ++i)
        if (mu[i] - mu[i - 1] > clear * mu[i]) return {mu[i - 1], mu[i]};
    const double largest = mu[mu.size() - 1];
    return largest > 0 ? Gap{largest, 1.002 * largest} : Gap{0, 2};
}

SymmetricPairs dense_pairs(const SparseMatrix& A, const Vector& M) {
    const DenseEigenpairs pairs = dense_eigenpairs(symmetric_form(A, M));
    const Eigen::Index n = A.rows();
    if (pairs.values[0] < -1e-10 * std::abs(pairs.values[n - 1])) {
        throw SolverError("−C has negative eigenvalues, so it is no Laplacian",
                          "repair triangles of zero area, and sum the opposite cotangents of an edge instead of averaging them");
    }
    const Vector constant = M.cwiseSqrt().normalized();
    DenseMatrix others = pairs.vectors.rightCols(n - 1);
    others -= constant * (constant.transpose() * others);
    others.colwise().normalize();
    return with_constant(M, pairs.values.tail(n - 1), others);
}

Modes modes_of(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    constexpr int dense_at_most = 3000;   // 1,800 rows took 12 s, and the time grows with the cube
    if (A.rows() <= options.dense_below) return dense_modes(A, M, k);
    if (options.engine) return options.engine(A, M, k);
    try {
        const SpectrumProblem problem(A, M);
        SpectrumOptions own = options;
        if (options.polish) own.tolerance = std::min(options.tolerance, 1e-12);
        own.threads = slices_that_fit(problem, k, options);
        Modes modes = find_by_slices(problem, k - 1, own);
        modes.pairs = with_constant(M, modes.pairs.mu, modes.pairs.Y);
        return modes;
    } catch (const CrowdedSpectrum&) {
        if (A.rows() > dense_at_most) throw;
        return dense_modes(A, M, k);
    }
}

}   // namespace meshfolio
