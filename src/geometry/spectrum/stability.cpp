#include "geometry/spectrum/stability.h"

#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"
#include "geometry/spectrum/top_lanczos.h"

namespace meshfolio {

double gershgorin_bound(const SparseMatrix& A, const Vector& M) {
    Vector row_sum = Vector::Zero(A.rows());
    Eigen::VectorXi entries = Eigen::VectorXi::Zero(A.rows());
    for (int j = 0; j < A.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
            row_sum[entry.row()] += std::abs(entry.value());
            ++entries[entry.row()];
        }
    }
    const double rounding = (entries.maxCoeff() + 2) * epsilon;   // of a sum and a quotient
    return row_sum.cwiseQuotient(M).maxCoeff() * (1 + rounding);
}

LargestEigenvalue top_mode(const OperatorWithMass& whole, double mu, Vector phi) {
    const Vector share = whole.M.cwiseProduct(phi.cwiseAbs2());   // Mφ², up to a factor
    phi /= std::sqrt(share.sum());
    LargestEigenvalue top;
    top.value = mu;
    top.upper_bound = gershgorin_bound(whole.A, whole.M);
    const Eigen::Index largest = first_largest(phi);
    if (phi[largest] < 0) phi = -phi;
    top.vertex = whole.vertex[std::size_t(largest)];
    top.mode = to_all_vertices(whole, phi);
    top.support = share.sum() * share.sum() / share.squaredNorm();
    return top;
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

double largest_stable_step(const LargestEigenvalue& top) { return top.value > 0 ? 2 / top.value : infinity; }

StepUnit step_unit_named(const std::string& name) {
    if (name == "raw") return StepUnit::raw;
    if (name == "tau") return StepUnit::tau;
    if (name == "h2") return StepUnit::h2;
    throw UsageError("unknown unit of lambda '" + printable(name) + "'", suggestion(name, {"raw", "tau", "h2"}) + "use raw, tau or h2");
}

double step_in_model_units(double lambda, StepUnit unit, double critical, double mean_edge) {
    switch (unit) {
        case StepUnit::tau: return lambda * critical;
        case StepUnit::h2: return lambda * mean_edge * mean_edge;
        case StepUnit::raw: break;
    }
    return lambda;
}

StepInUnits step_in_units(double raw, double critical, double mean_edge) { return {raw, raw / critical, raw / (mean_edge * mean_edge)}; }

double smoothing_strength(double diffusion_time, double diagonal) { return std::sqrt(4 * diffusion_time) / diagonal; }

}   // namespace meshfolio
