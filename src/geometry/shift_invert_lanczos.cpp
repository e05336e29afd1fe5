#include "geometry/shift_invert_lanczos.h"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "errors.h"

namespace meshfolio {

namespace {

constexpr int most_restarts = 300;

/// A − σM, with every diagonal entry stored so that the pattern is the same for each σ.
SparseMatrix shifted(const SparseMatrix& A, const Vector& M, double sigma) {
    SparseMatrix diagonal(A.rows(), A.cols());
    diagonal = (-sigma * M).asDiagonal();
    return A + diagonal;
}

/// The size of an ordinary eigenvalue where Σ M = 1: n times the median diagonal entry, which needles do not raise as they do
/// the mean, trace(A)/trace(M).
double ordinary_eigenvalue(const SparseMatrix& A) {
    Vector diagonal = A.diagonal();
    double* const middle = diagonal.data() + diagonal.size() / 2;
    std::nth_element(diagonal.data(), middle, diagonal.data() + diagonal.size());
    return double(A.rows()) * *middle;
}

/// σ = −10⁻⁶ of that: small against the eigenvalues sought, large enough for pivots that are surely positive. Farther below where
/// needles or specks make rounding larger.
SparseFactor factor_below_zero(const SparseMatrix& A, const Vector& M, double& sigma) {
    const double ordinary = ordinary_eigenvalue(A);
    std::string reason;
    for (const double share : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        sigma = ordinary > 0 ? -share * ordinary : -share;
        try {
            SparseFactor factor = SparseFactor::ldlt(shifted(A, M, sigma));
            if (factor.negative_pivots() == 0) return factor;
            reason = std::to_string(factor.negative_pivots()) + " eigenvalues are negative";
        } catch (const SolverError& error) {   // a pivot lost in rounding, or no memory
            reason = error.what();
        }
    }
    throw SolverError("−C is not positive semidefinite: " + reason,
                      "repair triangles of zero area, and sum the opposite cotangents of an edge instead of averaging them");
}

/// Uniform in (−½, ½), the same on every machine (splitmix64, Steele et al. 2014).
Vector start_vector(Eigen::Index n, int seed) {
    Vector v(n);
    std::uint64_t state = 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(seed + 1);
    for (double& x : v) {
        state += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        x = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53 - 0.5;
    }
    return v;
}

/// What Spectra multiplies with: P (B − σI)⁻¹ P, P the projection away from all that is known.
template <class Apply>
struct DeflatedOperator {
    using Scalar = double;
    const Apply& apply;
    Eigen::Index n;

    Eigen::Index rows() const { return n; }
    Eigen::Index cols() const { return n; }
    void perform_op(const double* in, double* out) const { Eigen::Map<Vector>(out, n) = apply(Eigen::Map<const Vector>(in, n)); }
};

}   // namespace

ZeroModes::ZeroModes(const SparseMatrix& A, const Vector& M) : components_(components_of(A)) {
    Vector mass = Vector::Zero(components_.count);
    for (Eigen::Index i = 0; i < M.size(); ++i) mass[components_.label[static_cast<std::size_t>(i)]] += M[i];
    y_.resize(M.size());
    for (Eigen::Index i = 0; i < M.size(); ++i) y_[i] = std::sqrt(M[i] / mass[components_.label[static_cast<std::size_t>(i)]]);
}

DenseMatrix ZeroModes::first(int count) const {
    DenseMatrix Z = DenseMatrix::Zero(y_.size(), count);
    for (Eigen::Index i = 0; i < y_.size(); ++i) {
        const int c = components_.label[static_cast<std::size_t>(i)];
        if (c < count) Z(i, c) = y_[i];
    }
    return Z;
}

void ZeroModes::project_out(Eigen::Ref<Vector> y) const {
    Vector part = Vector::Zero(components_.count);
    for (Eigen::Index i = 0; i < y.size(); ++i) part[components_.label[static_cast<std::size_t>(i)]] += y_[i] * y[i];
    for (Eigen::Index i = 0; i < y.size(); ++i) y[i] -= y_[i] * part[components_.label[static_cast<std::size_t>(i)]];
}

Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs) {
    Vector residuals(pairs.count());
    for (int j = 0; j < pairs.count(); ++j) {
        const Vector r = B * pairs.Y.col(j) - pairs.mu[j] * pairs.Y.col(j);
        const double size = root_mass.cwiseProduct(pairs.Y.col(j)).norm();
        residuals[j] = root_mass.cwiseProduct(r).norm() / (pairs.mu[j] > 0 ? pairs.mu[j] * size : 1);
    }
    return residuals;
}

int inertia_below(const SparseMatrix& A, const Vector& M, double sigma) {
    return SparseFactor::ldlt(shifted(A, M, sigma)).negative_pivots();
}

ShiftInvertLanczos::ShiftInvertLanczos(const SparseMatrix& A, const Vector& M, double tolerance, std::function<void(double)> progress)
    : A_(A),
      M_(M),
      tolerance_(tolerance),
      progress_(std::move(progress)),
      root_(M.cwiseSqrt()),
      B_(symmetric_form(A, M)),
      zero_modes_(A, M),
      factor_(factor_below_zero(A, M, sigma_)),
      known_{Vector(0), DenseMatrix(A.rows(), 0)} {}

int ShiftInvertLanczos::count_below(double sigma) const { return inertia_below(A_, M_, sigma); }

/// (B − σI)⁻¹ = M^½ (A − σM)⁻¹ M^½.
DenseMatrix ShiftInvertLanczos::apply(const DenseMatrix& Y) const {
    DenseMatrix W = root_.asDiagonal() * factor_.solve(DenseMatrix(root_.asDiagonal() * Y));
    for (Eigen::Index j = 0; j < W.cols(); ++j) zero_modes_.project_out(W.col(j));
    return W;
}

void ShiftInvertLanczos::find_more(int wanted) {
    const Eigen::Index n = A_.rows();
    wanted = std::min<int>(wanted, static_cast<int>(n) - zero_modes_.count() - known_.count());
    if (wanted < 1) return;
    const Eigen::Index basis = std::min<Eigen::Index>(n, std::max(2 * wanted + 10, 30));
    const auto deflated = [&](const Vector& y) {
        Vector w = y - known_.Y * (known_.Y.transpose() * y);
        w = apply(w);
        w -= known_.Y * (known_.Y.transpose() * w);
        ++operations_;
        if (progress_) progress_(0.95 * double(operations_) / double(operations_ + basis));
        return w;
    };
    DeflatedOperator<decltype(deflated)> op{deflated, n};
    Spectra::SymEigsSolver<DeflatedOperator<decltype(deflated)>> lanczos(op, wanted, basis);
    lanczos.init(deflated(start_vector(n, passes_++)).eval().data());
    lanczos.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance_);

    const DenseMatrix found = lanczos.eigenvectors();
    DenseMatrix all(n, known_.count() + found.cols());
    all << known_.Y, found;
    rayleigh_ritz(std::move(all));
    refine();
}

bool ShiftInvertLanczos::converged(int count) const {
    const SymmetricPairs first{known_.mu.head(count), known_.Y.leftCols(count)};
    const double rounding = 100 * std::numeric_limits<double>::epsilon() * B_.diagonal().cwiseAbs().maxCoeff();
    const Vector residuals = relative_residuals(B_, root_, first);
    return (residuals.array() <= (rounding / first.mu.array()).max(tolerance_)).all();
}

/// Inverse iteration on all known vectors together damps what is left in them of high eigenvectors by μ/μ_max.
void ShiftInvertLanczos::refine() {
    constexpr int most_refinements = 4;
    for (int i = 0; i < most_refinements && !converged(known_.count()); ++i) {
        rayleigh_ritz(apply(known_.Y) * (known_.mu.array() - sigma_).matrix().asDiagonal());
    }
}

/// Best approximations of eigenpairs in the span of W: (WᵀBW) q = μ (WᵀW) q, y = Wq.
void ShiftInvertLanczos::rayleigh_ritz(DenseMatrix W) {
    for (Eigen::Index j = 0; j < W.cols(); ++j) zero_modes_.project_out(W.col(j));
    const DenseMatrix H = W.transpose() * (B_ * W);
    const Eigen::GeneralizedSelfAdjointEigenSolver<DenseMatrix> small(H, W.transpose() * W);
    if (small.info() != Eigen::Success) throw SolverError("Rayleigh–Ritz of " + std::to_string(W.cols()) + " eigenvectors failed");
    known_ = {small.eigenvalues(), W * small.eigenvectors()};
}

}   // namespace meshfolio
