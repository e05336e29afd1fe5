/// @file
/// Solves (M − λC) X' = M X for many X, for several λ and for several positions of the same triangles.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

struct OperatorWithMass;

enum class LinearSolver { none, direct, conjugate_gradients, distributed };

/// A factor of a definite matrix held by several processes (geometry/distributed).
struct RemoteFactor {
    std::function<DenseMatrix(const DenseMatrix&)> solve;
    long long nonzeros = 0;
};
using FactorRemotely = std::function<RemoteFactor(const SparseMatrix&)>;

/// The work of a solver so far.
struct SolverWork {
    int analyses = 0, factorisations = 0;   // symbolic, numerical
    long long iterations = 0;               // of conjugate gradients
};

/// A solver that reuses its work from one system to the next: the elimination order while the pattern of the operator stays, the factor
/// while operator, masses and λ stay. Pass one solver to several runs. Rows are kept in elimination order, so that a step moves no data.
class ImplicitSolver {
public:
    /// Conjugate gradients end when ‖r‖ ≤ 10⁻¹¹ ‖M X‖ in the norm of M⁻¹, per coordinate. As M − λC ≥ M, this proves an error
    /// ≤ 10⁻¹¹ ‖X‖ in the norm of M.
    static constexpr double tolerance = 1e-11;

    ImplicitSolver();
    ~ImplicitSolver();

    /// Prepares the solution of (M − λC) X' = M X. Steps use conjugate gradients if a factor, by its symbolic analysis, exceeds
    /// `memory_limit`.
    /// @param memory_limit  [bytes]; 0: the available memory
    /// @param remotely      factors in other processes, without a limit; empty: in this one
    /// @throws SolverError if M − λC cannot be factored
    void prepare(const OperatorWithMass& whole, double lambda, double memory_limit = 0, const FactorRemotely& remotely = {});

    const std::vector<int>& vertex() const;   // the vertex of each row
    /// Replaces X, rows in the order of vertex(), by the solution X' of (M − λC) X' = M X. @throws SolverError if conjugate gradients do
    /// not end
    void step(FourColumns& X);
    /// Returns the solution X' of (M − λC) X' = M X, n × 3 for the whole mesh; copies move with their vertices, vertices without mass stay.
    Positions step(const Positions& X);

    LinearSolver solver() const;         // the solver prepared
    long long factor_nonzeros() const;   // of its factor, an incomplete one for conjugate gradients
    const SolverWork& work() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}   // namespace meshfolio
