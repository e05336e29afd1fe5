#include "geometry/smoothing/implicit_solver.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <new>
#include <optional>
#include <string>

#include "base/at.h"
#include "base/available_memory.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/smoothing/diffusion_step.h"

namespace meshfolio {
namespace {

bool same_pattern(const SparseMatrix& A, const SparseMatrix& B) {
    return A.rows() == B.rows() && A.nonZeros() == B.nonZeros() &&
           std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
           std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

/// Solves (I − λM^−½CM^−½) y = M^½ x by Eigen's conjugate gradients, preconditioned by the incomplete Cholesky factor, where a factor would
/// not fit into memory. The norm of its residual is that of M⁻¹.
class ConjugateGradients {
public:
    ConjugateGradients(const SparseMatrix& system, const Vector& M) : system_(symmetric_form(system, M)), root_(M.cwiseSqrt()) {
        solver_.setTolerance(ImplicitSolver::tolerance);
        solver_.setMaxIterations(most_iterations);
        solver_.compute(system_);
        if (solver_.info() != Eigen::Success) throw SolverError("conjugate gradients: the matrix is not positive definite");
    }

    /// Replaces X by X', starting from X. Returns the number of iterations, summed over the coordinates. @throws SolverError if they do not
    /// end
    long long solve(FourColumns& X) const {
        long long iterations = 0;
        for (Eigen::Index c = 0; c < 3; ++c) {
            const Vector y = root_.cwiseProduct(X.col(c));
            X.col(c) = solver_.solveWithGuess(y, y).cwiseQuotient(root_);
            iterations += solver_.iterations();
            if (solver_.info() == Eigen::Success) continue;
            throw SolverError("implicit step: conjugate gradients did not end within " + std::to_string(most_iterations) + " iterations",
                              "take a smaller lambda");
        }
        return iterations;
    }
    long long nonzeros() const { return solver_.preconditioner().matrixL().nonZeros(); }

private:
    static constexpr int most_iterations = 5000;

    SparseMatrix system_;
    Vector root_;
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<double>> solver_;
};

}   // namespace

struct ImplicitSolver::State {
    OperatorWithMass whole;   // as last prepared
    std::optional<EliminationOrder> order;
    double lambda = 0;
    LinearSolver ready = LinearSolver::none;
    std::optional<OrderedFactor> factor;
    std::optional<ConjugateGradients> gradients;
    RemoteFactor remote;
    std::vector<int> vertex;   // of each row of the steps
    Vector M;                  // in that order
    SolverWork work;

    /// True if a factor fits, as far as the symbolic analysis tells; one that cannot even be analysed does not fit.
    bool fits(double limit) const {
        constexpr double always_there = 16e6;   // asking the system takes as long as a small factor, and rebuilding asks at every step
        if (!order) return false;
        if (limit <= 0 && order->memory > always_there) limit = available_memory().bytes;
        return limit <= 0 || order->memory <= limit;
    }

    void analyse(const SparseMatrix& system) {
        order.reset();
        ++work.analyses;
        try {
            order.emplace(system);
        } catch (const std::bad_alloc&) {
        }
    }

    void factor_directly(const SparseMatrix& system) {
        const SparseMatrix ordered = order->apply(system);
        M = whole.M(order->row);
        factor.emplace(ordered, 0, OrderedFactor::Kind::definite);
        // M − λC ≥ M, so that a factor with rounding δ as large as the masses (xᵀEx ≤ δ xᵀMx) says nothing of them. Rare below this λμ_max:
        constexpr double harmless = 1e9;
        if (ordered.diagonal().cwiseQuotient(M).maxCoeff() >= harmless && !(factor->backward_error(M) < 1))
            throw SolverError("its rounding may be as large as the masses");
        vertex.clear();
        for (const int row : order->row) vertex.push_back(whole.vertex[at(row)]);
    }
};

ImplicitSolver::ImplicitSolver() : state_(std::make_unique<State>()) {}
ImplicitSolver::~ImplicitSolver() = default;

void ImplicitSolver::prepare(const OperatorWithMass& whole, double lambda, double memory_limit, const FactorRemotely& remotely) {
    State& s = *state_;
    const bool known =
        s.work.analyses > 0 && whole.vertex == s.whole.vertex && whole.copies == s.whole.copies && same_pattern(whole.A, s.whole.A);
    const auto same_numbers = [&] {
        return std::equal(whole.A.valuePtr(), whole.A.valuePtr() + whole.A.nonZeros(), s.whole.A.valuePtr()) && whole.M == s.whole.M;
    };
    if (known && lambda == s.lambda && !remotely && s.ready != LinearSolver::none && same_numbers() &&
        s.fits(memory_limit) == (s.ready == LinearSolver::direct))
        return;
    s.ready = LinearSolver::none;
    s.factor.reset();
    s.gradients.reset();
    s.whole = whole;
    s.lambda = lambda;
    const SparseMatrix mass(whole.M.asDiagonal()), system = mass + lambda * whole.A;   // M − λC
    if (!known && !remotely) s.analyse(system);
    const bool direct = !remotely && s.fits(memory_limit);
    s.vertex = whole.vertex;
    s.M = whole.M;
    try {
        if (remotely) s.remote = remotely(system);
        else if (direct) s.factor_directly(system);
        else s.gradients.emplace(system, whole.M);
    } catch (const SolverError& error) {
        throw SolverError("M − λC cannot be factored at this lambda: " + std::string(error.what()),
                          "take a smaller lambda, or repair triangles of zero area");
    }
    ++s.work.factorisations;
    s.ready = remotely ? LinearSolver::distributed : direct ? LinearSolver::direct : LinearSolver::conjugate_gradients;
}

const std::vector<int>& ImplicitSolver::vertex() const { return state_->vertex; }

void ImplicitSolver::step(FourColumns& X) {
    State& s = *state_;
    if (s.ready == LinearSolver::conjugate_gradients) {
        s.work.iterations += s.gradients->solve(X);
        return;
    }
    for_each_index(static_cast<int>(X.rows()), [&](int i) { row_of(X, i) *= s.M[i]; });
    if (s.ready == LinearSolver::direct) {
        s.factor->solve_in_place(X);
        return;
    }
    X.leftCols(3) = s.remote.solve(X.leftCols(3));
}

Positions ImplicitSolver::step(const Positions& X) {
    FourColumns rows = gathered(X, vertex());
    step(rows);
    Positions result = X;
    scatter(rows, vertex(), result);
    spread(state_->whole.copies, result);
    return result;
}

LinearSolver ImplicitSolver::solver() const { return state_->ready; }

long long ImplicitSolver::factor_nonzeros() const {
    if (state_->ready == LinearSolver::conjugate_gradients) return state_->gradients->nonzeros();
    if (state_->ready == LinearSolver::distributed) return state_->remote.nonzeros;
    return state_->order ? state_->order->operations.nonzeros : 0;
}

const SolverWork& ImplicitSolver::work() const { return state_->work; }

}   // namespace meshfolio
