/// @file
/// What a factorisation library must do for SparseFactor. Private to the layer.
#pragma once

#include <vector>

#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/sparse_factor.h"

namespace meshfolio {

enum class FactorKind { ldlt, cholesky };

struct FactorColumn {
    int count = 0;
    const int* rows = nullptr;
    const double* values = nullptr;
};

/// Columns of L of one pattern, stored with the zeros above their diagonals.
struct Supernode {
    int first = 0, columns = 0;
    int row_count = 0;   // the columns' own rows first
    const int* rows = nullptr;
    const double* values = nullptr;   // row_count × columns, column-major
};

/// Rows from which factoring by supernodes and ten solves are faster than column by column.
inline constexpr Eigen::Index supernodal_from = 100'000;

struct SparseFactor::Implementation {
    virtual ~Implementation() = default;
    virtual void analyze(const SparseMatrix& A) = 0;
    /// Numerical factorisation after `analyze`; false if the library gave up (a zero pivot, not positive definite).
    virtual bool factorize(const SparseMatrix& A) = 0;
    virtual DenseMatrix solve(const DenseMatrix& B) const = 0;
    /// Pivot belonging to each row of A: D of LDLᵀ, or the squared diagonal of the Cholesky factor.
    virtual Vector pivots() const = 0;
    virtual long long nonzeros() const = 0;   // of the factor; known after `analyze`

    /// The same analysis once more, to factor another matrix of the pattern at the same time.
    virtual std::unique_ptr<Implementation> analysed_copy(const SparseMatrix& A) const = 0;
    /// Row order()[i] of A is eliminated as the i-th.
    virtual std::vector<int> order() const = 0;
    /// Column j of L below the unit diagonal, rows ascending, in the order of elimination. Simplicial LDLᵀ only.
    virtual FactorColumn column(int j) const = 0;
    /// Supernodal LLᵀ only; 0: L is stored column by column.
    virtual int supernodes() const { return 0; }
    virtual Supernode supernode(int) const { return {}; }

    FactorKind kind = FactorKind::ldlt;
    Eigen::Index rows = 0;
    bool supernodal = false;   // asked for before `analyze`, where the library has it
    int negative = 0;          // pivots < 0
};

/// Analysed, not factored yet. `A` compressed.
std::unique_ptr<SparseFactor::Implementation> analysed(const SparseMatrix& A, FactorKind kind, FactorLibrary library);
std::unique_ptr<SparseFactor::Implementation> analysed(const SparseMatrix& A, FactorKind kind, FactorLibrary library, bool supernodal);
/// @throws SolverError if an entry is not finite
void check_finite(const SparseMatrix& A, FactorKind kind);
/// A pivot is what is left of a diagonal entry after the elimination. Below a few roundings of that entry its sign means nothing.
/// @throws SolverError if one is, or is not finite
void check_pivots(const Vector& pivots, const Vector& diagonal, FactorKind kind);
/// Numerical factorisation, with every pivot checked.
/// @throws SolverError if an entry is not finite or a pivot is lost in rounding
void factorize_checked(SparseFactor::Implementation& factor, const SparseMatrix& A);

/// From simplicial LDLᵀ or supernodal LLᵀ.
LdltPanels panels_of(const SparseFactor::Implementation& L);

std::unique_ptr<SparseFactor::Implementation> factor_by_eigen(FactorKind kind);
#ifdef MESHFOLIO_WITH_CHOLMOD
std::unique_ptr<SparseFactor::Implementation> factor_by_cholmod(FactorKind kind);
#endif

}   // namespace meshfolio
