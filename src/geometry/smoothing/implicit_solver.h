/// @file
/// (M − λC) X' = M X for many X, and again for other λ and other positions of the same triangles.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

struct OperatorWithMass;

enum class LinearSolver { none, direct, conjugate_gradients, distributed };

/// A factor of a definite matrix that is held elsewhere, by several processes (geometry/distributed).
struct RemoteFactor {
    std::function<DenseMatrix(const DenseMatrix&)> solve;
    long long nonzeros = 0;
};
using FactorRemotely = std::function<RemoteFactor(const SparseMatrix&)>;

/// Keeps what it can from one system to the next: the order of elimination as long as the operator's pattern is the same, the factor as
/// long as operator, mass and λ are. To be handed from run to run by whoever makes several. Rows are kept in the order of elimination, so
/// that a step moves nothing about.
class ImplicitSolver {
public:
    /// Conjugate gradients end when ‖r‖ ≤ 10⁻¹¹ ‖M X‖ in the norm of M⁻¹, per coordinate. As M − λC ≥ M, this proves an error
    /// ≤ 10⁻¹¹ ‖X‖ in the norm of M.
    static constexpr double tolerance = 1e-11;

    ImplicitSolver();
    ~ImplicitSolver();
    ImplicitSolver(ImplicitSolver&&) noexcept;
    ImplicitSolver& operator=(ImplicitSolver&&) noexcept;

    /// Readies the system. Steps are made by conjugate gradients where a factor, by its symbolic analysis, exceeds `memory_limit`.
    /// @param memory_limit  [bytes]; 0: what the machine has left
    /// @param remotely      factors elsewhere, without a limit; empty: here
    /// @throws SolverError if M − λC cannot be factored
    void prepare(const OperatorWithMass& whole, double lambda, double memory_limit = 0, const FactorRemotely& remotely = {});

    const std::vector<int>& vertex() const;   // of each row
    /// X := X'. @throws SolverError if conjugate gradients do not end
    void step(FourColumns& X);
    /// n × 3 for the whole mesh; copies go with their vertices, those without mass stay.
    Positions step(const Positions& X);

    LinearSolver solver() const;         // that is ready
    long long factor_nonzeros() const;   // of its factor, an incomplete one for conjugate gradients
    /// So far: symbolic analyses, numerical factorisations, iterations of conjugate gradients.
    int analyses() const;
    int factorisations() const;
    long long iterations() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}   // namespace meshfolio
