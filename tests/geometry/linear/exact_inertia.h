/// @file
/// Inertia in exact rational arithmetic, for small matrices. Every double is an exact number.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio::testing {

/// Negative eigenvalues of A − σM, by symmetric elimination with the largest diagonal pivot, and sums of two rows where all diagonals
/// vanish.
/// @throws std::domain_error if the matrix is singular
inline int exact_inertia(const DenseMatrix& A, const Vector& M, double sigma) {
    const auto n = static_cast<std::size_t>(A.rows());
    std::vector<std::vector<mpq_class>> S(n, std::vector<mpq_class>(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const auto row = static_cast<Eigen::Index>(std::max(i, j)), column = static_cast<Eigen::Index>(std::min(i, j));
            S[i][j] = A(row, column);   // its lower triangle
        }
        S[i][i] -= mpq_class(sigma) * mpq_class(M[static_cast<Eigen::Index>(i)]);
    }
    std::vector<std::size_t> left(n);
    for (std::size_t i = 0; i < n; ++i) left[i] = i;
    const auto eliminate = [&](std::size_t p) {
        for (const std::size_t i : left) {
            if (S[i][p] == 0) continue;
            const mpq_class l = S[i][p] / S[p][p];
            for (const std::size_t j : left) {
                if (j <= i) S[i][j] = S[j][i] = S[i][j] - l * S[p][j];
            }
        }
    };
    int negative = 0;
    while (!left.empty()) {
        auto pivot = left.begin();
        for (auto p = left.begin(); p != left.end(); ++p) {
            if (abs(S[*p][*p]) > abs(S[*pivot][*pivot])) pivot = p;
        }
        if (S[*pivot][*pivot] == 0) {   // add a coupled row to this one: a congruence
            auto other = left.end();
            for (auto q = left.begin(); q != left.end(); ++q) {
                if (S[*pivot][*q] != 0) other = q;
            }
            if (other == left.end()) throw std::domain_error("exact_inertia: singular");
            const mpq_class coupling = S[*pivot][*other];
            for (const std::size_t j : left) S[*pivot][j] = S[j][*pivot] = S[*pivot][j] + S[*other][j];
            S[*pivot][*pivot] = 2 * coupling;
        }
        const std::size_t p = *pivot;
        negative += S[p][p] < 0 ? 1 : 0;
        left.erase(pivot);
        eliminate(p);
    }
    return negative;
}

}   // namespace meshfolio::testing
