// Coefficients of the damped step: Jackson's factors as in Weiße et al. 2006, eq. 71; the recurrence as in Hammond et al. 2011.
#include "geometry/spectrum/chebyshev_filter.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

namespace {

/// Series of the step that is 1 for t < t_c: c_0 = 1 − θ_c/π, c_j = −2 sin(jθ_c)/(jπ), cos θ_c = t_c.
Vector step_series(double t_cutoff, int degree) {
    const double angle = std::acos(std::clamp(t_cutoff, -1.0, 1.0));
    Vector c(degree + 1);
    c[0] = 1 - angle / pi;
    for (int j = 1; j <= degree; ++j) c[j] = -2 * std::sin(j * angle) / (j * pi);
    return c;
}

/// Jackson's factors: the series of a positive kernel as narrow as the degree allows.
Vector jackson_factors(int degree) {
    const double N = degree + 1, a = pi / (N + 1);
    Vector g(degree + 1);
    for (int j = 0; j <= degree; ++j) g[j] = ((N - j + 1) * std::cos(j * a) + std::sin(j * a) / std::tan(a)) / (N + 1);
    return g;
}

/// Series of any function of t ∈ [−1, 1] from its values at Chebyshev's points, enough of them that aliases vanish with the series.
template <class Function>
Vector series_of(Function f, int degree) {
    const int points = 2 * degree + 64;
    Vector values(points);
    for (int i = 0; i < points; ++i) values[i] = f(std::cos(pi * (i + 0.5) / points));
    Vector c(degree + 1);
    for (int j = 0; j <= degree; ++j) {
        double sum = 0;
        for (int i = 0; i < points; ++i) sum += values[i] * std::cos(pi * j * (i + 0.5) / points);
        c[j] = (j == 0 ? 1.0 : 2.0) / points * sum;
    }
    return c;
}

/// T_j(−1) = (−1)^j.
double at_zero(const Vector& c) {
    double sum = 0;
    for (Eigen::Index j = 0; j < c.size(); ++j) sum += j % 2 == 0 ? c[j] : -c[j];
    return sum;
}

}   // namespace

double low_pass_response(LowPass kind, double cutoff, double mu) {
    if (kind == LowPass::ideal) return mu < cutoff ? 1 : 0;
    return std::exp2(-(mu / cutoff) * (mu / cutoff));
}

ChebyshevFilter chebyshev_low_pass(LowPass kind, double cutoff, double bound, int degree) {
    if (degree < 1 || !(cutoff > 0) || !(bound > 0) || !std::isfinite(cutoff) || !std::isfinite(bound)) {
        throw MeshError("chebyshev_low_pass: degree " + std::to_string(degree) + ", cutoff " + std::to_string(cutoff) + ", bound " +
                        std::to_string(bound));
    }
    ChebyshevFilter filter{{}, bound};
    if (kind == LowPass::ideal) {
        filter.coefficients = step_series(2 * cutoff / bound - 1, degree).cwiseProduct(jackson_factors(degree));
    } else {
        filter.coefficients = series_of([&](double t) { return low_pass_response(kind, cutoff, 0.5 * bound * (t + 1)); }, degree);
    }
    filter.coefficients /= at_zero(filter.coefficients);
    return filter;
}

double response(const ChebyshevFilter& filter, double mu) {
    const double t = 2 * mu / filter.bound - 1;
    double b1 = 0, b2 = 0;
    for (int j = filter.degree(); j > 0; --j) {
        const double b = filter.coefficients[j] + 2 * t * b1 - b2;
        b2 = b1;
        b1 = b;
    }
    return filter.coefficients[0] + t * b1 - b2;
}

Positions filtered(const ChebyshevFilter& filter, const LaplaceBeltrami& laplacian, const Positions& X) {
    return filtered({&filter, 1}, laplacian, X).front();
}

/// T_{j+1} = 2S T_j − T_{j−1}, S = (2/b) M⁻¹(−C) − I, on positions about a point of the mesh: far from the origin, rounding of (−C)1 = 0
/// times the distance would be all one sees.
std::vector<Positions> filtered(std::span<const ChebyshevFilter> filters, const LaplaceBeltrami& laplacian, const Positions& X) {
    if (laplacian.M.size() != X.rows() || laplacian.C.rows() != X.rows()) throw MeshError("a filter's operator is of another mesh");
    if (filters.empty()) return {};
    const double bound = filters.front().bound;
    int highest = 0;
    for (const ChebyshevFilter& filter : filters) {
        if (filter.bound != bound) throw MeshError("filters of different bounds cannot share their products");
        highest = std::max(highest, filter.degree());
    }
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const Eigen::SparseMatrix<double, Eigen::RowMajor> S = weighted_by_rows(whole.A, (2 / bound) * whole.M.cwiseInverse());
    const Eigen::RowVector3d centre = X.row(whole.vertex.front());
    Positions now = X(whole.vertex, Eigen::all).rowwise() - centre, before;
    std::vector<Positions> sums(filters.size(), Positions::Zero(now.rows(), 3));
    for (int j = 0; j <= highest; ++j) {
        if (j == 1) {
            before = now;
            now = S * before - before;
        } else if (j > 1) {
            before = 2 * (S * now - now) - before;
            before.swap(now);
        }
        for (std::size_t i = 0; i < filters.size(); ++i) {
            if (j <= filters[i].degree()) sums[i] += filters[i].coefficients[j] * now;
        }
    }
    std::vector<Positions> results(filters.size(), X);
    for (std::size_t i = 0; i < filters.size(); ++i) results[i](whole.vertex, Eigen::all) = sums[i].rowwise() + centre;
    return results;
}

/// A product takes two for each entry, the recurrence and the sum six for each number.
double operations(const ChebyshevFilter& filter, const LaplaceBeltrami& laplacian) {
    const double entries = static_cast<double>(laplacian.C.nonZeros()), rows = static_cast<double>(laplacian.M.size());
    return 3.0 * filter.degree() * (2 * entries + 6 * rows);
}

}   // namespace meshfolio
