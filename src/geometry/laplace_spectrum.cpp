#include "geometry/laplace_spectrum.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "errors.h"
#include "geometry/shift_invert_lanczos.h"

namespace meshfolio {

namespace {

/// The eigenvalues below `sigma`, counted by inertia and among those found.
struct InertiaCount {
    double sigma = 0;
    int counted = -1, found = -1;
};

/// The k pairs asked for, in symmetric form, zero modes first.
struct Modes {
    SymmetricPairs pairs;
    InertiaCount inertia;
    bool dense = false;
};

/// A σ in the first clear gap of the ascending `mu` behind its k-th entry. A cluster is never cut: rounding would decide on
/// which side of σ its members are.
std::optional<double> shift_in_gap_behind(const Vector& mu, int k) {
    constexpr double clear = 1e-5;
    for (Eigen::Index i = k; i < mu.size(); ++i) {
        if (mu[i] - mu[i - 1] > clear * mu[i]) return 0.5 * (mu[i - 1] + mu[i]);
    }
    return std::nullopt;
}

int entries_below(const Vector& mu, double sigma) { return static_cast<int>((mu.array() < sigma).count()); }

Vector with_zeros(int zeros, const Vector& mu) {
    Vector all(zeros + mu.size());
    all << Vector::Zero(zeros), mu;
    return all;
}

/// The first k pairs of zero modes and others together.
SymmetricPairs first_pairs(const ZeroModes& zero_modes, const SymmetricPairs& others, int k) {
    const int zeros = std::min(zero_modes.count(), k);
    SymmetricPairs first{with_zeros(zeros, others.mu.head(k - zeros)), DenseMatrix(others.Y.rows(), k)};
    first.Y << zero_modes.first(zeros), others.Y.leftCols(k - zeros);
    return first;
}

Modes dense_modes(const SparseMatrix& A, const Vector& M, int k) {
    const ZeroModes zero_modes(A, M);
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> solver{DenseMatrix(symmetric_form(A, M))};
    if (solver.info() != Eigen::Success) throw SolverError("the dense eigensolver did not converge");
    const Eigen::Index n = A.rows(), others = n - zero_modes.count();
    if (solver.eigenvalues()[0] < -1e-10 * std::abs(solver.eigenvalues()[n - 1])) {
        throw SolverError("−C has negative eigenvalues, so it is no Laplacian",
                          "repair triangles of zero area, and sum the opposite cotangents of an edge instead of averaging them");
    }
    SymmetricPairs nonzero{solver.eigenvalues().tail(others), solver.eigenvectors().rightCols(others)};
    for (Eigen::Index j = 0; j < others; ++j) {
        zero_modes.project_out(nonzero.Y.col(j));
        nonzero.Y.col(j).normalize();
    }
    Modes modes{first_pairs(zero_modes, nonzero, k), {}, true};
    const Vector mu = with_zeros(zero_modes.count(), nonzero.mu);
    const double above_all = mu[n - 1] > 0 ? 1.001 * mu[n - 1] : 1;
    modes.inertia.sigma = shift_in_gap_behind(mu, k).value_or(above_all);
    modes.inertia.counted = inertia_below(A, M, modes.inertia.sigma);
    modes.inertia.found = entries_below(mu, modes.inertia.sigma);
    return modes;
}

/// Lanczos passes until a shift behind the k-th pair has as many eigenvalues below it as were found.
Modes lanczos_modes(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    constexpr int most_passes = 12;
    constexpr int beyond = 6;   // pairs more than asked for, to see where a cluster ends
    ShiftInvertLanczos lanczos(A, M, options.tolerance, options.progress);
    const int zeros = lanczos.zero_modes().count();
    InertiaCount inertia;
    int wanted = k - zeros + beyond + k / 30;
    for (int pass = 0; pass < most_passes; ++pass) {
        if (wanted > 0) lanczos.find_more(wanted);
        const Vector mu = with_zeros(zeros, lanczos.known().mu);
        if (inertia.counted < 0) {
            if (const auto sigma = shift_in_gap_behind(mu, k)) inertia = {*sigma, lanczos.count_below(*sigma), -1};
        }
        inertia.found = entries_below(mu, inertia.sigma);
        if (inertia.found == inertia.counted && lanczos.converged(std::max(0, k - zeros))) {
            return {first_pairs(lanczos.zero_modes(), lanczos.known(), k), inertia, false};
        }
        const int missing = inertia.counted - inertia.found;
        const int to_the_next_gap = std::max(0, k - static_cast<int>(mu.size())) + (beyond << pass);
        wanted = inertia.counted < 0 ? to_the_next_gap : std::max(1, missing);
    }
    throw SolverError("the " + std::to_string(k) + " smallest eigenpairs did not converge: inertia counts " +
                          std::to_string(inertia.counted) + " eigenvalues below the shift, " + std::to_string(inertia.found) +
                          " were found",
                      "ask for fewer eigenpairs, or repair the mesh's needles");
}

Modes modes_of(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    const Eigen::Index n = A.rows();
    if (n <= options.dense_below || 3 * k > n) return dense_modes(A, M, k);
    return lanczos_modes(A, M, k, options);
}

}   // namespace

Spectrum smallest_eigenpairs(const LaplaceBeltrami& laplacian, int k, const SpectrumOptions& options) {
    if (k < 1) throw MeshError("smallest_eigenpairs: k = " + std::to_string(k), "ask for at least one");
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const double total = whole.M.sum();
    const Vector M = whole.M / total;   // in units where the area is 1, whatever the model's
    k = std::min(k, whole.size());
    const Modes modes = modes_of(whole.A, M, k, options);

    const Vector root = M.cwiseSqrt();
    Spectrum spectrum;
    spectrum.residuals = relative_residuals(symmetric_form(whole.A, M), root, modes.pairs);
    spectrum.eigenvalues = modes.pairs.mu / total;
    DenseMatrix Phi = (root * std::sqrt(total)).cwiseInverse().asDiagonal() * modes.pairs.Y;
    for (int j = 0; j < k; ++j) {
        if (Phi(first_largest(Phi.col(j)), j) < 0) Phi.col(j) *= -1;
    }
    spectrum.eigenvectors = to_all_vertices(whole, Phi);
    spectrum.dense = modes.dense;
    spectrum.inertia_count = modes.inertia.counted;
    spectrum.found_below = modes.inertia.found;
    spectrum.inertia_shift = modes.inertia.sigma / total;
    if (options.progress) options.progress(1);
    return spectrum;
}

double orthonormality_error(const Spectrum& spectrum, const Vector& M) {
    const DenseMatrix& Phi = spectrum.eigenvectors;
    const DenseMatrix gram = Phi.transpose() * (M.asDiagonal() * Phi);
    return (gram - DenseMatrix::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

}   // namespace meshfolio
