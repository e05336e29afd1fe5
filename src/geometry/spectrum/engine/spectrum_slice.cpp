#include "geometry/spectrum/engine/spectrum_slice.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <string>

#include "base/errors.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

namespace {

SparseMatrix with_whole_diagonal(const SparseMatrix& B) {
    SparseMatrix zero(B.rows(), B.cols());
    zero = Vector::Zero(B.rows()).asDiagonal();
    return B + zero;
}

/// What a shift may be moved by when a pivot is lost there.
constexpr double nudges[] = {0, 1e-7, -2e-7, 1e-6, -2e-6, 1e-5, -2e-5};

template <class Try>   // (σ)
auto with_nudges(double& sigma, const Try& attempt) {
    const double wanted = sigma;
    std::exception_ptr failure;
    for (const double nudge : nudges) {
        sigma = wanted * (1 + nudge);
        try {
            return attempt(sigma);
        } catch (const SolverError&) {
            failure = std::current_exception();
        }
    }
    std::rethrow_exception(failure);
}

/// LDLᵀ is not pivoted: where σ makes some leading part nearly singular, pivots and rounding grow. Then σ is moved within its slice.
LdltPanels factor_within(const SpectrumProblem& problem, const SliceGoal& goal, double& sigma) {
    constexpr double harmless_growth = 1e3, moves[] = {0, 0.02, -0.02, 0.05, -0.05};
    double least_growth = infinity, best = goal.sigma;
    for (const double move : moves) {
        sigma = goal.sigma + move * (goal.high - goal.low);
        try {
            LdltPanels factor = problem.factor(sigma, goal.parallel);
            if (factor.growth <= harmless_growth) return factor;
            if (factor.growth < least_growth) {
                least_growth = factor.growth;
                best = sigma;
            }
        } catch (const SolverError&) {   // a pivot lost in rounding
        }
    }
    sigma = best;
    return with_nudges(sigma, [&](double s) { return problem.factor(s, goal.parallel); });
}

/// Farther below where needles or specks make rounding larger.
LdltPanels factor_below_zero(const SpectrumProblem& problem, const SliceGoal& goal, double& sigma) {
    constexpr int most_attempts = 5;
    std::string reason;
    bool refuted = false;
    for (int i = 0; i < most_attempts; ++i) {
        try {
            LdltPanels factor = problem.factor(sigma, goal.parallel);
            if (factor.negative_pivots() == 0) return factor;
            const int negative = factor.negative_pivots();
            reason = std::to_string(negative) + (negative == 1 ? " eigenvalue is negative" : " eigenvalues are negative");
            refuted = shifted_backward_error(factor, sigma) < -sigma;
            if (!refuted) reason += " by a count that rounding may have changed";
        } catch (const SolverError& error) {   // a pivot lost in rounding
            reason = error.what();
            refuted = false;
        }
        sigma *= 10;
    }
    throw SolverError((refuted ? "−C is not positive semidefinite: " : "−C cannot be shown to be positive semidefinite: ") + reason,
                      "repair triangles of zero area, and sum the opposite cotangents of an edge instead of averaging them");
}

/// Relative residual from which a pair outside the slice shows where a gap is.
constexpr double witness_tolerance = 1e-6;

/// The converged run of Ritz pairs from `low` up to the first clear gap beyond the goal.
struct Run {
    std::vector<int> chosen;
    double cut = 0;
};

/// @param above_sigma  eigenvalues above σ
/// @param all          those of the whole spectrum that are not zero
std::optional<Run> finished_run(const RitzPairs& ritz, const SliceGoal& goal, int above_sigma, int all) {
    Run run;
    const double start = goal.low * (1 - clear_gap);
    int below = 0, above = 0;
    double last = -infinity;
    for (int i = 0; i < ritz.count(); ++i) {
        const double mu = ritz.mu[i];
        if (mu <= 0 || !std::isfinite(mu)) continue;
        if (mu < start) {   // the next one below the slice shows that nothing is left at its lower end
            const bool is_next = i + 1 < ritz.count() && ritz.mu[i + 1] >= start;
            if (is_next && ritz.residual[i] > witness_tolerance) return std::nullopt;
            continue;
        }
        const bool beyond = mu > goal.high && static_cast<int>(run.chosen.size()) >= goal.at_least;
        if (ritz.residual[i] > (beyond ? witness_tolerance : goal.tolerance)) return std::nullopt;
        const bool gap = mu - last > clear_gap * mu;
        if (gap && beyond) {
            if (goal.below_sigma >= 0 && below < goal.below_sigma) return std::nullopt;
            run.cut = run.chosen.empty() ? 0.5 * (std::max(goal.low, 0.0) + mu) : 0.5 * (last + mu);
            return run;
        }
        if (ritz.residual[i] > goal.tolerance) return std::nullopt;
        run.chosen.push_back(i);
        (mu < goal.sigma ? below : above) += 1;
        last = mu;
    }
    const bool at_the_end = goal.to_the_end && above == above_sigma && (goal.below_sigma < 0 || below >= goal.below_sigma);
    if (!at_the_end && static_cast<int>(run.chosen.size()) < all) return std::nullopt;
    run.cut = infinity;
    return run;
}

}   // namespace

SpectrumProblem::SpectrumProblem(const SparseMatrix& A, const Vector& M)
    : B(with_whole_diagonal(symmetric_form(A, M))), zeros(A, M), analysis(B), zeros_in_order(zeros.reordered(analysis.order())) {}

SparseMatrix SpectrumProblem::B_in_order() const {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> to_row(size());
    std::copy(analysis.order().begin(), analysis.order().end(), to_row.indices().data());
    SparseMatrix permuted;
    permuted = B.twistedBy(to_row.transpose());
    return permuted;
}

Inertia count_near(const SpectrumProblem& problem, double sigma) {
    return with_nudges(sigma, [&](double s) { return problem.analysis.count_below(problem.B, s, true); });
}

Slice solve_slice(const SpectrumProblem& problem, const SliceGoal& goal, const std::vector<const EightColumns*>& locked,
                  const StepReport& report) {
    constexpr int steps_between_looks = 2;
    Slice slice;
    slice.goal = goal;
    const double start = seconds();
    const LdltPanels factor =
        goal.sigma < 0 ? factor_below_zero(problem, goal, slice.goal.sigma) : factor_within(problem, goal, slice.goal.sigma);
    slice.counted = factor.negative_pivots();
    slice.delta = shifted_backward_error(factor, slice.goal.sigma);
    slice.times.factor = seconds() - start;
    if (goal.low <= 0 && locked.empty()) slice.goal.below_sigma = slice.counted - (goal.sigma > 0 ? problem.zeros.count() : 0);

    const SparseMatrix B = goal.polish ? problem.B_in_order() : SparseMatrix();
    BlockLanczos lanczos(factor, problem.zeros_in_order, locked, {slice.goal.sigma, goal.seed, goal.polish ? &B : nullptr, goal.parallel});
    const int left = problem.size() - problem.zeros.count();
    const double vectors_a_pair = goal.sigma > goal.low ? 2 : 3;   // at the least: σ in the middle of its slice, or at its lower end
    int next_look = std::min(goal.largest_basis, 40 + static_cast<int>(vectors_a_pair * goal.expected));
    while (!slice.complete && lanczos.basis_size() + EightColumns::width <= goal.largest_basis) {
        lanczos.advance();
        slice.basis = lanczos.basis_size();
        report(std::min(1.0, double(slice.basis) / goal.largest_basis));
        if (slice.basis < next_look) continue;
        next_look = slice.basis + steps_between_looks * EightColumns::width;
        const RitzPairs ritz = lanczos.ritz_pairs();
        const auto run = finished_run(ritz, slice.goal, problem.size() - slice.counted, left);
        if (!run) continue;
        slice.complete = true;
        slice.cut = run->cut;
        slice.mu = ritz.mu(run->chosen);
        slice.X = lanczos.take_vectors(ritz, run->chosen);
    }
    slice.times += lanczos.times;
    return slice;
}

}   // namespace meshfolio
