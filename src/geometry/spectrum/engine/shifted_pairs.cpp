#include "geometry/spectrum/engine/shifted_pairs.h"

#include <Spectra/SymEigsShiftSolver.h>
#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "base/errors.h"
#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/linear/random_numbers.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// The operator y ↦ P(B − σI)⁻¹P y in the form of Spectra; P projects orthogonally to the constant and to the known pairs.
class DeflatedInverse {
public:
    using Scalar = double;

    DeflatedInverse(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search)
        : problem_(problem), shift_(shift), known_(known), search_(search) {}

    Eigen::Index rows() const { return problem_.size(); }
    Eigen::Index cols() const { return problem_.size(); }
    void set_shift(double) {}   // the factor exists already

    void perform_op(const double* in, double* out) const {
        if (search_.report) search_.report(std::min(1.0, ++steps_ / (3.0 * search_.wanted + 20)));
        Eigen::Map<DenseMatrix> y(out, rows(), 1);
        y = Eigen::Map<const DenseMatrix>(in, rows(), 1);
        apply(y);
    }
    void apply(Eigen::Ref<DenseMatrix> Y) const {
        project(Y);
        shift_.factor.solve_in_place(Y);
        project(Y);
    }
    void project(Eigen::Ref<DenseMatrix> Y) const {
        Y -= problem_.zero * (problem_.zero.transpose() * Y);
        if (known_.cols() > 0) Y -= known_ * (known_.transpose() * Y);
    }

private:
    const SpectrumProblem& problem_;
    const Shift& shift_;
    const DenseMatrix& known_;
    const PairSearch& search_;
    mutable int steps_ = 0;
};

}   // namespace meshfolio

/// Spectra's products with the basis V of Lanczos. Spectra removes Vᵀf from f until no more than ε‖f‖ is left, several times a step: a
/// third of the time at 97,000 vertices, k = 150. Here shares below 10⁻¹² count as 0; the vectors are still orthonormal to 10⁻¹¹.
template <> class Spectra::ArnoldiOp<double, meshfolio::DeflatedInverse, Spectra::IdentityBOp> {
public:
    ArnoldiOp(const meshfolio::DeflatedInverse& inverse, const IdentityBOp&) : inverse_(inverse) {}

    Eigen::Index rows() const { return inverse_.rows(); }
    void perform_op(const double* in, double* out) const { inverse_.perform_op(in, out); }
    template <class X> double norm(const X& x) const { return x.norm(); }
    template <class X, class Y> double inner_product(const X& x, const Y& y) const { return x.dot(y); }
    template <class V, class F> void trans_product(const V& basis, const F& f, Eigen::Ref<Eigen::VectorXd> shares) const {
        shares.noalias() = basis.transpose() * f;
        if (shares.cwiseAbs().maxCoeff() <= 1e-12 * f.norm()) shares.setZero();
    }

private:
    const meshfolio::DeflatedInverse& inverse_;
};

namespace meshfolio {

namespace {

/// Returns the Ritz pairs of B in the space that Y spans. Y R⁻¹ has orthonormal columns with Cholesky's factor RᵀR of YᵀY, applied twice:
/// exact to rounding unless they are nearly dependent (Yamamoto et al. 2015).
SymmetricPairs rayleigh_ritz(const SparseMatrix& B, DenseMatrix Y) {
    if (Y.cols() == 0) return {Vector(0), Y};
    for (int pass = 0; pass < 2; ++pass) {
        const Eigen::LLT<DenseMatrix> gram(DenseMatrix(Y.transpose() * Y));
        if (gram.info() != Eigen::Success)
            throw SolverError(std::to_string(Y.cols()) + " eigenvectors found are linearly dependent", "ask for fewer eigenpairs");
        gram.matrixU().solveInPlace<Eigen::OnTheRight>(Y);
    }
    const DenseEigenpairs ritz = dense_eigenpairs(Y.transpose() * (B * Y));
    return {ritz.values, Y * ritz.vectors};
}

/// Returns the pairs with noise, vectors of large eigenvalues added by rounding, removed by one more solve, which multiplies it by μ/‖B‖.
SymmetricPairs without_noise(const SpectrumProblem& problem, const DeflatedInverse& inverse, SymmetricPairs pairs, double tolerance) {
    constexpr int most_rounds = 3;
    for (int round = 0; round < most_rounds && pairs.count() > 0; ++round) {
        const Vector residuals = residuals_of(problem.B, pairs);
        if ((residuals.array() <= tolerance).all()) break;
        for (int j = 0; j < pairs.count(); ++j) {
            if (residuals[j] <= tolerance) continue;
            inverse.apply(pairs.Y.col(j));
            pairs.Y.col(j).normalize();
        }
        pairs = rayleigh_ritz(problem.B, std::move(pairs.Y));
    }
    return pairs;
}

/// Returns the pairs with small residuals: after restarts among close Ritz values Lanczos may report others as converged. With needles,
/// rounding leaves some ε‖B‖/μ in every residual.
SymmetricPairs verified(const SpectrumProblem& problem, const SymmetricPairs& pairs, double tolerance) {
    const Vector residuals = residuals_of(problem.B, pairs);
    std::vector<Eigen::Index> good;
    for (Eigen::Index j = 0; j < residuals.size(); ++j) {
        const double rounding = std::min(1e-3, 1e3 * epsilon * problem.highest / std::abs(pairs.mu[j]));
        if (residuals[j] <= std::max(tolerance, rounding)) good.push_back(j);
    }
    return {pairs.mu(good), pairs.Y(Eigen::all, good)};
}

DenseMatrix random_columns(Eigen::Index rows, int columns, std::uint64_t seed) {
    DenseMatrix Y(rows, columns);
    for (double& number : Y.reshaped()) number = uniform_number(seed);
    return Y;
}

/// Returns the pairs in ascending order of eigenvalues.
SymmetricPairs ascending(const Vector& mu, const DenseMatrix& Y) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(mu.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return mu[a] < mu[b]; });
    return {mu(order), Y(Eigen::all, order)};
}

}   // namespace

SymmetricPairs merged(const SymmetricPairs& a, const SymmetricPairs& b) {
    if (a.count() == 0) return b;
    Vector mu(a.count() + b.count());
    mu << a.mu, b.mu;
    DenseMatrix Y(a.Y.rows(), mu.size());
    Y << a.Y, b.Y;
    return ascending(mu, Y);
}

SymmetricPairs part_of(const SymmetricPairs& pairs, int first, int last) {
    return {pairs.mu.segment(first, last - first), pairs.Y.middleCols(first, last - first)};
}

SpectrumProblem::SpectrumProblem(const SparseMatrix& A, const Vector& M)
    : symmetric(symmetric_form(A, M) + SparseMatrix(Vector::Zero(M.size()).asDiagonal())),
      order(symmetric),
      B(order.apply(symmetric)),
      zero(M(order.row).cwiseSqrt().normalized()) {
    Vector row_sum = Vector::Zero(size());
    for (int j = 0; j < size(); ++j)
        for (SparseMatrix::InnerIterator entry(B, j); entry; ++entry) row_sum[j] += std::abs(entry.value());
    highest = row_sum.maxCoeff() > 0 ? 1.001 * row_sum.maxCoeff() : 1;
}

double Shift::delta() const { return factor.backward_error(Vector::Ones(factor.size()), 1) + epsilon * std::abs(sigma); }

Shift shift_near(const SpectrumProblem& problem, double sigma, double reach) {
    constexpr double harmless_growth = 1e4;
    std::optional<Shift> best;
    std::string reason;
    for (const double move : {0.0, 0.4, -0.4, 1.0, -1.0}) {
        try {
            Shift shift{sigma + move * reach, {problem.B, sigma + move * reach, OrderedFactor::Kind::indefinite}};
            if (shift.factor.growth() <= harmless_growth) return shift;
            if (!best || shift.factor.growth() < best->factor.growth()) best = std::move(shift);
        } catch (const SolverError& error) {   // a pivot lost in rounding
            reason = error.what();
        }
    }
    if (!best) throw SolverError(reason, "simplify the mesh, or repair its needles");
    return *std::move(best);
}

Shift shift_below_zero(const SpectrumProblem& problem, double sigma) {
    constexpr int most_attempts = 5;
    std::string reason;
    bool refuted = false;
    for (int i = 0; i < most_attempts; ++i, sigma *= 10) {
        try {
            Shift shift{sigma, {problem.B, sigma, OrderedFactor::Kind::indefinite}};
            const int negative = shift.factor.negative_pivots();
            if (negative == 0) return shift;
            refuted = shift.delta() < -sigma;
            reason = std::to_string(negative) + (negative == 1 ? " eigenvalue is negative" : " eigenvalues are negative") +
                     (refuted ? "" : " by a count that rounding may have changed");
        } catch (const SolverError& error) {   // a pivot lost in rounding
            reason = error.what();
            refuted = false;
        }
    }
    throw SolverError(
        (refuted ? "the stiffness matrix −C is not positive semidefinite: "
                 : "the stiffness matrix −C cannot be shown to be positive semidefinite: ") +
            reason,
        "repair triangles of zero area; in an operator of your own, sum the opposite cotangents of an edge instead of averaging them");
}

SymmetricPairs pairs_near(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search) {
    constexpr int most_restarts = 12;
    constexpr double converged = 1e-11;   // of 1/(μ − σ), and of the share of other vectors in each
    const Eigen::Index left = problem.others() - known.cols(), pairs = std::min<Eigen::Index>(search.wanted, left);
    if (pairs < 1) return {Vector(0), DenseMatrix(problem.size(), 0)};
    const DeflatedInverse inverse(problem, shift, known, search);
    DenseMatrix start = random_columns(problem.size(), 1, 1 + static_cast<std::uint64_t>(known.cols()));
    inverse.project(start);
    auto op = inverse;
    Spectra::SymEigsShiftSolver<DeflatedInverse> lanczos(op, pairs, std::min<Eigen::Index>(pairs + 3 * pairs / 2 + 10, problem.size()),
                                                         shift.sigma);
    lanczos.init(start.data());
    const Eigen::Index found = lanczos.compute(Spectra::SortRule::LargestMagn, most_restarts, converged);
    SymmetricPairs pairs_found = ascending(lanczos.eigenvalues(), lanczos.eigenvectors(found));
    return verified(problem, without_noise(problem, inverse, std::move(pairs_found), search.tolerance), std::max(search.tolerance, 1e-9));
}

SymmetricPairs pairs_by_iteration(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search) {
    constexpr int most_rounds = 12, more = 8;
    const auto block = static_cast<int>(std::min<Eigen::Index>(search.wanted + more, problem.others() - known.cols()));
    const DeflatedInverse inverse(problem, shift, known, search);
    SymmetricPairs pairs{Vector(0), random_columns(problem.size(), std::max(0, block), 7)};
    for (int round = 0; round < most_rounds && block > 0; ++round) {
        if (search.report) search.report(double(round) / most_rounds);
        inverse.apply(pairs.Y);
        pairs.Y.colwise().normalize();
        pairs = rayleigh_ritz(problem.B, std::move(pairs.Y));
    }
    return verified(problem, pairs, std::max(search.tolerance, 1e-9));
}

Vector residuals_of(const SparseMatrix& B, const SymmetricPairs& pairs) {
    const DenseMatrix R = B * pairs.Y - pairs.Y * pairs.mu.asDiagonal();
    return R.colwise().norm().transpose().cwiseQuotient(pairs.mu.cwiseAbs());
}

}   // namespace meshfolio
