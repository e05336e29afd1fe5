#include "geometry/spectrum/stability.h"

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"
#include "geometry/spectrum/top_lanczos.h"

namespace meshfolio {

namespace {

constexpr int dense_up_to = 200;

TopPair dense_top(const SparseMatrix& B) {
    const DenseEigenpairs pairs = dense_eigenpairs(B);
    return {pairs.values.tail(1)[0], pairs.vectors.rightCols(1), 0, 0};
}

}   // namespace

double gershgorin_bound(const SparseMatrix& A, const Vector& M) {
    Vector row_sum = Vector::Zero(A.rows());
    Eigen::VectorXi entries = Eigen::VectorXi::Zero(A.rows());
    for (int j = 0; j < A.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
            row_sum[entry.row()] += std::abs(entry.value());
            ++entries[entry.row()];
        }
    }
    const double rounding = (entries.maxCoeff() + 2) * std::numeric_limits<double>::epsilon();   // of a sum and a quotient
    return row_sum.cwiseQuotient(M).maxCoeff() * (1 + rounding);
}

Vector irregular_direction(int n) {
    Vector y(n);
    for (int i = 0; i < n; ++i) y[i] = static_cast<double>((i * 2654435761LL + 12345) % 1000003) / 1000003 - 0.5;
    return y.normalized();
}

LargestEigenvalue top_mode(const OperatorWithMass& whole, double mu, Vector phi) {
    const Vector share = whole.M.cwiseProduct(phi.cwiseAbs2());   // Mφ², up to a factor
    phi /= std::sqrt(share.sum());
    LargestEigenvalue top;
    top.value = mu;
    top.upper_bound = gershgorin_bound(whole.A, whole.M);
    const Eigen::Index largest = first_largest(phi);
    if (phi[largest] < 0) phi = -phi;
    top.vertex = whole.vertex[static_cast<std::size_t>(largest)];
    top.mode = to_all_vertices(whole, phi);
    top.support = share.sum() * share.sum() / share.squaredNorm();
    return top;
}

TopEstimate top_estimate(const OperatorWithMass& whole, const TopSearch& search, const Vector& start) {
    const double total = whole.M.sum();
    const Vector M = whole.M / total;   // in units where the area is 1, whatever the model's
    const SparseMatrix B = symmetric_form(whole.A, M);
    Vector y = irregular_direction(whole.size());
    if (start.size() == whole.all_vertices) {
        const Vector warm = start(whole.vertex).cwiseProduct(M.cwiseSqrt());
        // Started from an eigenvector alone, Lanczos would have nowhere to go.
        if (warm.allFinite() && warm.squaredNorm() > 0) y = warm.normalized() + 0.1 * y;
    }
    const TopPair pair =
        whole.size() <= dense_up_to ? dense_top(B) : top_by_lanczos(B, y, {search.change, search.residual, search.most_steps});
    if (!std::isfinite(pair.value)) throw SolverError("largest eigenvalue: the operator has weights that are not finite");
    return {pair.value / total, pair.y.cwiseQuotient(M.cwiseSqrt()), pair.change, pair.residual};
}

LargestEigenvalue largest_eigenvalue(const LaplaceBeltrami& laplacian) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    constexpr TopSearch search{.residual = 1e-13};
    const TopEstimate estimate = top_estimate(whole, search);
    if (estimate.change <= search.change && estimate.residual <= search.residual) return top_mode(whole, estimate.mu, estimate.phi);
    const Enclosure enclosure =
        enclose_largest(whole.A, whole.M, estimate.phi, {.high = gershgorin_bound(whole.A, whole.M), .missing = estimate.change});
    return top_mode(whole, enclosure.quotient, enclosure.y);
}

LargestEigenvalue largest_eigenvalue_nearly(const OperatorWithMass& whole, const Vector& start) {
    const TopEstimate estimate = top_estimate(whole, {.change = 1e-9, .most_steps = 300}, start);
    return top_mode(whole, estimate.mu, estimate.phi);
}

double largest_stable_step(const LargestEigenvalue& top) { return top.value > 0 ? 2 / top.value : std::numeric_limits<double>::infinity(); }

StepUnit step_unit_named(const std::string& name) {
    if (name == "raw") return StepUnit::raw;
    if (name == "tau") return StepUnit::tau;
    if (name == "h2") return StepUnit::h2;
    throw UsageError("unknown unit of lambda '" + printable(name) + "'", suggestion(name, {"raw", "tau", "h2"}) + "use raw, tau or h2");
}

double step_in_model_units(double lambda, StepUnit unit, double critical, double mean_edge) {
    switch (unit) {
        case StepUnit::tau:
            return lambda * critical;
        case StepUnit::h2:
            return lambda * mean_edge * mean_edge;
        case StepUnit::raw:
            break;
    }
    return lambda;
}

StepInUnits step_in_units(double raw, double critical, double mean_edge) { return {raw, raw / critical, raw / (mean_edge * mean_edge)}; }

double smoothing_strength(double diffusion_time, double diagonal) { return std::sqrt(4 * diffusion_time) / diagonal; }

}   // namespace meshfolio
