/// @file
/// LDLᵀ of sparse symmetric matrices by Eigen's simplicial factorisation, without pivoting: one factorisation, many solves, the inertia
/// from the signs of the pivots, and a bound of the rounding.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "geometry/linear/aligned_columns.h"
#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// The cost of LDLᵀ, counted from the pattern alone.
struct FactorOperations {
    long long nonzeros = 0;     // of the factor, diagonal included
    double factorisation = 0;   // multiply–adds
    double solve = 0;           // of one solve with one right-hand side: L, D and Lᵀ
};
/// Returns the multiply–adds of LDLᵀ for the pattern of S, eliminated in the order of its rows. @param S  symmetric, both triangles and
/// every diagonal entry stored
FactorOperations factor_operations(const SparseMatrix& S);

/// Returns A with row and column row[i] moved to i; entries ascend in each column.
SparseMatrix in_order(const SparseMatrix& A, const std::vector<int>& row);

/// An elimination order that keeps the factor sparse, by approximate minimum degree (Amestoy, Davis & Duff 1996).
struct EliminationOrder {
    /// @param A  its pattern counts: symmetric, both triangles and every diagonal entry stored
    /// @throws SolverError if A is empty or not square
    explicit EliminationOrder(const SparseMatrix& A);

    std::vector<int> row;   // row row[i] is eliminated at step i; neighbours on the surface are mostly near each other in this order
    FactorOperations operations;
    double memory = 0;   // a bound for making and keeping a factor [bytes]
    SparseMatrix apply(const SparseMatrix& A) const { return in_order(A, row); }
};

/// LDLᵀ of S − σI in the order of the rows of S.
class OrderedFactor {
public:
    enum class Kind { indefinite, definite };

    /// @param S  symmetric, its upper triangle read, every diagonal entry stored, in an order of elimination
    /// @throws SolverError if an entry is not finite, or a pivot within a few roundings of zero, or negative where `kind` forbids it
    OrderedFactor(const SparseMatrix& S, double sigma, Kind kind);

    /// Replaces X by (S − σI)⁻¹ X, rows in elimination order. Several threads may call it at once.
    void solve_in_place(Eigen::Ref<DenseMatrix> X) const;
    void solve_in_place(FourColumns& X) const;

    int size() const { return static_cast<int>(D_.size()); }
    /// Returns the number of negative pivots: by Sylvester's law, the number of negative eigenvalues of a matrix near S − σI.
    int negative_pivots() const { return static_cast<int>((D_.array() < 0).count()); }
    /// Returns the largest |pivot / diagonal entry of S − σI|: rounding grows with it.
    double growth() const { return growth_; }

    /// Returns δ with |xᵀEx| ≤ δ xᵀWx for all x, where L D Lᵀ = S − σI + E holds exactly for the computed factors.
    ///
    /// An entry with m products before it has |E_ij| ≤ γ_{m+1} (|L||D||Lᵀ|)_ij, γ_m = mu/(1 − mu), u = 2⁻⁵³, in whatever order
    /// they are summed (Higham 2002, lemma 8.4 and theorem 9.3, with one rounding more for l_ij = y_j/d_j). Row i of L has t_i entries left
    /// of the diagonal, so m ≤ min(t_i, t_j). For any x > 0 the norm of W^−½EW^−½ is at most max_i (|E|x)_i/(W_i x_i) (Collatz–Wielandt):
    ///     δ = u · max_i (t_i + 3)(|L||D||Lᵀ|x)_i / (W_i x_i).
    /// Of the three, one is that of the division, one covers rounding of the diagonal by the caller, u|S_ii| ≤ u(|L||D||Lᵀ|)_ii, and one
    /// the terms of order u². Products that underflow add 2⁻¹⁰²² each. x is 1 in the first pass over L and improved in each further one; on
    /// surfaces, two passes give a δ two to four times smaller than one.
    /// @param W  a weight > 0 for each row, in the order of elimination
    /// @return   infinity if a number is not finite
    double backward_error(const Vector& W, int passes = 2) const;

private:
    using Ldlt = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>>;
    std::shared_ptr<const Ldlt> ldlt_;   // cannot be moved
    Vector D_;
    double growth_ = 1;
};

/// LDLᵀ of a matrix in any row order.
class SparseFactor {
public:
    /// Factors a symmetric matrix (lower triangle read, every diagonal entry stored), indefinite allowed as long as no pivot vanishes.
    /// @throws SolverError if a pivot is zero, within a few roundings of it, or not finite
    static SparseFactor ldlt(const SparseMatrix& A) { return {A.selfadjointView<Eigen::Lower>(), OrderedFactor::Kind::indefinite}; }
    /// Factors with D > 0: Cholesky's factor is L D^½.
    /// @throws SolverError if A is not positive definite
    static SparseFactor cholesky(const SparseMatrix& A) { return {A.selfadjointView<Eigen::Lower>(), OrderedFactor::Kind::definite}; }

    /// Returns A⁻¹B; B has as many rows as A. Several threads may call it at once.
    DenseMatrix solve(const DenseMatrix& B) const;
    Vector solve(const Vector& b) const { return solve(DenseMatrix(b)).col(0); }

    int negative_pivots() const { return factor_.negative_pivots(); }
    long long nonzeros() const { return order_.operations.nonzeros; }   // of the factor, diagonal included
    /// Returns δ with |xᵀEx| ≤ δ xᵀWx for all x (OrderedFactor::backward_error()); W has the order of the rows of A.
    double backward_error(const Vector& W) const { return factor_.backward_error(W(order_.row)); }

private:
    SparseFactor(const SparseMatrix& whole, OrderedFactor::Kind kind) : order_(whole), factor_(order_.apply(whole), 0, kind) {}

    EliminationOrder order_;
    OrderedFactor factor_;
};

}   // namespace meshfolio
