#include "geometry/linear/ldlt_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/linear/special_values.h"

namespace meshfolio {

namespace {

/// visit(column, w, rows below, their count, values): the panel's own w × w, its lower triangle alone, then w of each row below.
template <class Visit>
void for_each_panel(const LdltPanels& L, const Visit& visit) {
    for (int p = 0; p < L.panels(); ++p) {
        const auto panel = static_cast<std::size_t>(p);
        visit(L.first[panel], L.first[panel + 1] - L.first[panel], L.rows.data() + L.row_start[panel],
              L.row_start[panel + 1] - L.row_start[panel], L.values.data() + L.value_start[panel]);
    }
}

/// t_i + 3 for each row of L.
Vector roundings_of_rows(const LdltPanels& L) {
    Vector roundings = Vector::Constant(L.size, 3.0);
    for_each_panel(L, [&](int column, int w, const int* rows, std::size_t below, const double*) {
        for (int c = 0; c < w; ++c) roundings[column + c] += c;
        for (std::size_t q = 0; q < below; ++q) roundings[rows[q]] += w;
    });
    return roundings;
}

/// |L||D||Lᵀ|x, all in the order of elimination.
Vector sum_of_sizes(const LdltPanels& L, const Vector& x) {
    Vector sum = Vector::Zero(L.size);
    for_each_panel(L, [&](int column, int w, const int* rows, std::size_t below, const double* values) {
        double outer[LdltPanels::widest];   // |D||Lᵀ|x of the panel's columns
        for (int c = 0; c < w; ++c) outer[c] = x[column + c];
        const double* l = values;
        for (int r = 0; r < w; ++r, l += w)
            for (int c = 0; c < r; ++c) outer[c] += std::abs(l[c]) * x[column + r];
        for (std::size_t q = 0; q < below; ++q, l += w)
            for (int c = 0; c < w; ++c) outer[c] += std::abs(l[c]) * x[rows[q]];
        for (int c = 0; c < w; ++c) outer[c] *= std::abs(L.pivots[column + c]);
        l = values;
        for (int r = 0; r < w; ++r, l += w) {
            sum[column + r] += outer[r];
            for (int c = 0; c < r; ++c) sum[column + r] += std::abs(l[c]) * outer[c];
        }
        for (std::size_t q = 0; q < below; ++q, l += w)
            for (int c = 0; c < w; ++c) sum[rows[q]] += std::abs(l[c]) * outer[c];
    });
    return sum;
}

}   // namespace

double backward_error(const LdltPanels& factor, const Vector& W, int passes) {
    constexpr double u = std::numeric_limits<double>::epsilon() / 2, underflow = std::numeric_limits<double>::min();
    const Vector weight = W(factor.order), roundings = roundings_of_rows(factor);
    Vector x = Vector::Ones(factor.size);
    double least = infinity;
    for (int pass = 0; pass < passes; ++pass) {
        const Vector sizes = sum_of_sizes(factor, x);
        const Vector ratio = (roundings.array() * (u * sizes.array() + underflow) / (weight.array() * x.array())).matrix();
        const double largest = ratio.maxCoeff(), smallest = ratio.minCoeff();
        if (!ratio.allFinite() || !(smallest > 0)) break;   // a maximum may pass over a NaN
        least = std::min(least, largest);
        x.array() *= (ratio.array() / largest).sqrt();
    }
    return least;
}

double shifted_backward_error(const LdltPanels& factor, double sigma) {
    return backward_error(factor, Vector::Ones(factor.size), 1) + epsilon * std::abs(sigma);
}

}   // namespace meshfolio
