// Factorisations by Eigen: SimplicialLDLT and SimplicialLLT with AMD ordering.
#include <Eigen/SparseCholesky>

#include "geometry/linear/factor_implementation.h"

namespace meshfolio {

namespace {

using LDLT = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower>;
using LLT = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower>;

/// d in the order of the factor, returned in the order of the matrix.
Vector in_matrix_order(const Vector& d, const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>& Pinv) {
    return Pinv.size() > 0 ? Vector(Pinv * d) : d;
}

/// The analysis sets the size of the factor, but matrixL() shows it only once there are numbers in it.
template <class Solver>
struct SizedSolver : Solver {
    long long entries() const { return this->m_matrix.nonZeros(); }
};

template <class Solver>
class EigenFactor final : public SparseFactor::Implementation {
public:
    void analyze(const SparseMatrix& A) override { solver_.analyzePattern(A); }
    bool factorize(const SparseMatrix& A) override {
        solver_.factorize(A);
        return solver_.info() == Eigen::Success;
    }
    DenseMatrix solve(const DenseMatrix& B) const override { return solver_.solve(B); }
    Vector pivots() const override {
        if constexpr (std::is_same_v<Solver, LDLT>) {
            return in_matrix_order(solver_.vectorD(), solver_.permutationPinv());
        } else {
            const SparseMatrix& L = solver_.matrixL().nestedExpression();
            return in_matrix_order(L.diagonal().cwiseAbs2(), solver_.permutationPinv());
        }
    }
    std::unique_ptr<Implementation> analysed_copy(const SparseMatrix& A) const override {
        auto copy = std::make_unique<EigenFactor>();   // Eigen's solvers cannot be copied
        copy->kind = kind;
        copy->rows = rows;
        copy->analyze(A);
        return copy;
    }
    std::vector<int> order() const override {
        const auto& Pinv = solver_.permutationPinv();   // empty when the order is kept
        std::vector<int> order(static_cast<std::size_t>(rows));
        for (int i = 0; i < static_cast<int>(rows); ++i) order[static_cast<std::size_t>(i)] = Pinv.size() > 0 ? Pinv.indices()[i] : i;
        return order;
    }
    FactorColumn column(int j) const override {
        const SparseMatrix& L = solver_.matrixL().nestedExpression();
        const int start = L.outerIndexPtr()[j];
        return {L.outerIndexPtr()[j + 1] - start, L.innerIndexPtr() + start, L.valuePtr() + start};
    }
    long long nonzeros() const override {
        const long long unit_diagonal = std::is_same_v<Solver, LDLT> ? rows : 0;   // kept implicit in LDLᵀ
        return solver_.entries() + unit_diagonal;
    }

private:
    SizedSolver<Solver> solver_;
};

}   // namespace

std::unique_ptr<SparseFactor::Implementation> factor_by_eigen(FactorKind kind) {
    if (kind == FactorKind::ldlt) return std::make_unique<EigenFactor<LDLT>>();
    return std::make_unique<EigenFactor<LLT>>();
}

}   // namespace meshfolio
