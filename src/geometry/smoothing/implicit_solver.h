/// @file
/// (M − λC) X' = M X for many X, and again for other λ and other positions of the same triangles.
#pragma once

#include <memory>
#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

struct OperatorWithMass;
class Ranks;

enum class LinearSolver { none, direct, conjugate_gradients, distributed };

/// Keeps what it can from one system to the next: the vertices' order and the symbolic analysis as long as the operator's pattern is the
/// same, the factor as long as operator, mass and λ are. To be handed from run to run by whoever makes several. Rows are kept in the
/// order of elimination, so that a step moves nothing about.
class ImplicitSolver {
public:
    ImplicitSolver();
    ~ImplicitSolver();
    ImplicitSolver(ImplicitSolver&&) noexcept;
    ImplicitSolver& operator=(ImplicitSolver&&) noexcept;

    /// Readies the system. Steps are made by conjugate gradients where a factor, by its symbolic analysis, exceeds `memory_limit`.
    /// @param X             positions of the whole mesh: along them the vertices are sorted when the pattern is a new one
    /// @param memory_limit  [bytes]; 0: what the machine has left
    /// @param ranks         of several processes, that factor together, without a limit, and outlive the steps; nullptr: this one does
    /// @throws SolverError if M − λC cannot be factored
    void prepare(const OperatorWithMass& whole, double lambda, const Positions& X, double memory_limit = 0, Ranks* ranks = nullptr);

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
