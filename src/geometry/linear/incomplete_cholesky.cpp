#include "geometry/linear/incomplete_cholesky.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"

namespace meshfolio {

namespace {

/// The entries of A left of the diagonal and within the block of their row.
IncompleteCholesky lower_blocks(const SparseMatrix& A) {
    const int n = static_cast<int>(A.rows());
    IncompleteCholesky L;
    L.pivots = A.diagonal();
    L.start.reserve(static_cast<std::size_t>(n) + 1);
    L.start.push_back(0);
    for (int i = 0; i < n; ++i) {
        if (!(std::isfinite(L.pivots[i]) && L.pivots[i] > 0))
            throw SolverError("conjugate gradients: row " + std::to_string(i) + " has no positive diagonal");
        const int block = i / block_length * block_length;
        for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {
            if (entry.row() < block || entry.row() >= i) continue;
            L.column.push_back(static_cast<std::int32_t>(entry.row()));
            L.value.push_back(entry.value());
        }
        L.start.push_back(static_cast<std::uint32_t>(L.column.size()));
    }
    return L;
}

/// Σ_k l_ik d_k l_jk over the entries that rows i and j have in common left of column j.
double common_products(const IncompleteCholesky& L, std::uint32_t i, std::uint32_t end_of_i, int j) {
    double sum = 0;
    std::uint32_t b = L.start[static_cast<std::size_t>(j)];
    const std::uint32_t end_of_j = L.start[static_cast<std::size_t>(j) + 1];
    while (i < end_of_i && b < end_of_j) {
        if (L.column[i] == L.column[b]) {
            sum += L.value[i] * L.pivots[L.column[i]] * L.value[b];
            ++i, ++b;
        } else {
            L.column[i] < L.column[b] ? ++i : ++b;
        }
    }
    return sum;
}

/// Factors the rows [begin, end), whose entries are still those of A. False where a pivot is lost.
bool factor_block(IncompleteCholesky& L, const SparseMatrix& A, int begin, int end, double shift) {
    constexpr double least_pivot = 1e-3;   // of the diagonal entry it is what is left of
    for (int i = begin; i < end; ++i) {
        const double diagonal = A.coeff(i, i) * (1 + shift);
        double pivot = diagonal;
        const std::uint32_t start = L.start[static_cast<std::size_t>(i)], stop = L.start[static_cast<std::size_t>(i) + 1];
        for (std::uint32_t k = start; k < stop; ++k) {
            const int j = L.column[k];
            L.value[k] = (L.value[k] - common_products(L, start, k, j)) / L.pivots[j];
            pivot -= L.value[k] * L.value[k] * L.pivots[j];
        }
        if (!(pivot > least_pivot * diagonal)) return false;
        L.pivots[i] = pivot;
    }
    return true;
}

}   // namespace

IncompleteCholesky incomplete_cholesky(const SparseMatrix& A) {
    const IncompleteCholesky entries = lower_blocks(A);
    IncompleteCholesky L = entries;
    const auto shifts = of_blocks(entries.rows(), [&](int begin, int end) {
        double shift = 0;
        while (!factor_block(L, A, begin, end, shift)) {
            shift = shift > 0 ? 4 * shift : 1e-3;
            std::copy(entries.value.begin() + entries.start[static_cast<std::size_t>(begin)],
                      entries.value.begin() + entries.start[static_cast<std::size_t>(end)],
                      L.value.begin() + entries.start[static_cast<std::size_t>(begin)]);
        }
        return shift;
    });
    for (const auto& block : shifts) L.shift = std::max(L.shift, block.value);
    return L;
}

void solve(const IncompleteCholesky& factor, const FourColumns& R, FourColumns& Z) {
    const std::uint32_t* const start = factor.start.data();
    for_blocks(factor.rows(), [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            Four z = row_of(R, i);
            for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) z -= factor.value[k] * row_of(Z, factor.column[k]);
            row_of(Z, i) = z;
        }
        for (int i = begin; i < end; ++i) row_of(Z, i) /= factor.pivots[i];
        for (int i = end - 1; i >= begin; --i) {
            const Four z = row_of(Z, i);
            for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) row_of(Z, factor.column[k]) -= factor.value[k] * z;
        }
    });
}

}   // namespace meshfolio
