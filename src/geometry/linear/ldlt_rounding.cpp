#include "geometry/linear/ldlt_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/linear/factor_implementation.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

namespace {

using Implementation = SparseFactor::Implementation;

/// t_i + 3 for each row of L.
Vector roundings_of_rows(const Implementation& L) {
    Vector roundings = Vector::Constant(L.rows, 3.0);
    for (int j = 0; j < static_cast<int>(L.rows); ++j) {
        const FactorColumn column = L.column(j);
        for (int q = 0; q < column.count; ++q) roundings[column.rows[q]] += 1;
    }
    return roundings;
}

/// |L||D||Lᵀ|x, all in the order of elimination.
Vector sum_of_sizes(const Implementation& L, const Vector& D, const Vector& x) {
    Vector sum = Vector::Zero(L.rows);
    for (int j = 0; j < static_cast<int>(L.rows); ++j) {
        const FactorColumn column = L.column(j);
        double inner = x[j];
        for (int q = 0; q < column.count; ++q) inner += std::abs(column.values[q]) * x[column.rows[q]];
        const double outer = std::abs(D[j]) * inner;
        sum[j] += outer;
        for (int q = 0; q < column.count; ++q) sum[column.rows[q]] += outer * std::abs(column.values[q]);
    }
    return sum;
}

}   // namespace

double backward_error(const Implementation& L, const Vector& W, int passes) {
    constexpr double u = std::numeric_limits<double>::epsilon() / 2, underflow = std::numeric_limits<double>::min();
    const std::vector<int> order = L.order();
    const Vector D = L.pivots()(order), weight = W(order), roundings = roundings_of_rows(L);
    Vector x = Vector::Ones(L.rows);
    double least = infinity;
    for (int pass = 0; pass < passes; ++pass) {
        const Vector sizes = sum_of_sizes(L, D, x);
        const Vector ratio = (roundings.array() * (u * sizes.array() + underflow) / (weight.array() * x.array())).matrix();
        const double largest = ratio.maxCoeff(), smallest = ratio.minCoeff();
        if (!ratio.allFinite() || !(smallest > 0)) break;   // a maximum may pass over a NaN
        least = std::min(least, largest);
        x.array() *= (ratio.array() / largest).sqrt();
    }
    return least;
}

}   // namespace meshfolio
