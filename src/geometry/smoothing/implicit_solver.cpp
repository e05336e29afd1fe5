#include "geometry/smoothing/implicit_solver.h"

#include <new>
#include <optional>
#include <string>

#include "base/available_memory.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/distributed/ranks.h"
#include "geometry/linear/ldlt_analysis.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/panel_kernels.h"
#include "geometry/measures/spatial_order.h"
#include "geometry/smoothing/conjugate_gradients.h"
#include "geometry/smoothing/diffusion_step.h"

namespace meshfolio {

namespace {

bool same_pattern(const SparseMatrix& A, const SparseMatrix& B) {
    return A.rows() == B.rows() && A.nonZeros() == B.nonZeros() &&
           std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
           std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

bool same_numbers(const OperatorWithMass& a, const OperatorWithMass& b) {
    return std::equal(a.A.valuePtr(), a.A.valuePtr() + a.A.nonZeros(), b.A.valuePtr()) && a.M == b.M;
}

/// M − λC = M + λA.
SparseMatrix system_of(const OperatorWithMass& whole, double lambda) {
    SparseMatrix mass(whole.A.rows(), whole.A.cols());
    mass = whole.M.asDiagonal();
    return mass + lambda * whole.A;
}

/// M − λC ≥ M, so that a factor whose rounding δ reaches the masses (xᵀEx ≤ δ xᵀMx) says nothing of them any more. Only asked where λμ_max
/// is large: it takes a tenth of the time of the factor.
/// @throws SolverError there
void require_masses_above_rounding(const LdltPanels& factor, const SparseMatrix& system, const Vector& M) {
    constexpr double harmless = 1e9;
    if (system.diagonal().cwiseQuotient(M).maxCoeff() < harmless) return;
    if (!(backward_error(factor, M) < 1)) throw SolverError("its rounding may be as large as the masses");
}

}   // namespace

struct ImplicitSolver::State {
    OperatorWithMass whole;   // as it came last
    std::vector<int> curve;   // its rows along Morton's curve
    std::optional<LdltAnalysis> analysis;
    double lambda = 0;
    LinearSolver ready = LinearSolver::none;
    LdltPanels factor;
    std::optional<ConjugateGradients> gradients;
    Ranks* ranks = nullptr;
    std::vector<int> vertex;   // of each row of the steps
    Vector M;                  // in that order
    int analyses = 0, factorisations = 0;
    long long iterations = 0;

    /// What would fit is known only after the symbolic analysis; one that cannot even be made does not fit either.
    bool fits(double limit) const {
        constexpr double always_there = 16e6;   // asking the system takes as long as a small factor, and rebuilding asks at every step
        if (!analysis) return false;
        if (limit <= 0 && analysis->memory() > always_there) limit = available_memory().bytes;
        return limit <= 0 || analysis->memory() <= limit;
    }

    void analyse(const SparseMatrix& system) {
        analysis.reset();
        ++analyses;
        try {
            analysis.emplace(system);
        } catch (const std::bad_alloc&) {
        }
    }

    void take_rows(const OperatorWithMass& sorted, const std::vector<int>& order) {
        vertex.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) vertex[i] = sorted.vertex[static_cast<std::size_t>(order[i])];
        M = sorted.M(order);
    }
};

ImplicitSolver::ImplicitSolver() : state_(std::make_unique<State>()) {}
ImplicitSolver::~ImplicitSolver() = default;
ImplicitSolver::ImplicitSolver(ImplicitSolver&&) noexcept = default;
ImplicitSolver& ImplicitSolver::operator=(ImplicitSolver&&) noexcept = default;

void ImplicitSolver::prepare(const OperatorWithMass& whole, double lambda, const Positions& X, double memory_limit, Ranks* ranks) {
    State& s = *state_;
    const bool known =
        s.analyses > 0 && whole.vertex == s.whole.vertex && whole.copies == s.whole.copies && same_pattern(whole.A, s.whole.A);
    if (known && lambda == s.lambda && ranks == nullptr && s.ready != LinearSolver::none && same_numbers(whole, s.whole) &&
        s.fits(memory_limit) == (s.ready == LinearSolver::direct))
        return;
    s.ready = LinearSolver::none;
    s.factor = {};
    s.gradients.reset();
    if (!known) s.curve = morton_order(X(whole.vertex, Eigen::all));
    s.whole = whole;
    s.lambda = lambda;
    const OperatorWithMass sorted = reordered(whole, s.curve);
    const SparseMatrix system = system_of(sorted, lambda);
    if (!known && ranks == nullptr) s.analyse(system);
    const bool direct = ranks == nullptr && s.fits(memory_limit);
    try {
        if (ranks != nullptr) {
            ranks->factor(system, true);
            s.vertex = sorted.vertex;
            s.M = sorted.M;
        } else if (direct) {
            s.factor = s.analysis->factor_definite(system, true);
            require_masses_above_rounding(s.factor, system, sorted.M);
            s.take_rows(sorted, s.factor.order);
        } else {
            s.gradients.emplace(sorted, system, lambda);
            s.vertex = sorted.vertex;
        }
    } catch (const SolverError& error) {
        throw SolverError("M − λC cannot be factored at this lambda: " + std::string(error.what()),
                          "take a smaller lambda, or repair triangles of zero area");
    }
    ++s.factorisations;
    s.ranks = ranks;
    s.ready = ranks != nullptr ? LinearSolver::distributed : direct ? LinearSolver::direct : LinearSolver::conjugate_gradients;
}

const std::vector<int>& ImplicitSolver::vertex() const { return state_->vertex; }

void ImplicitSolver::step(FourColumns& X) {
    State& s = *state_;
    if (s.ready == LinearSolver::conjugate_gradients) {
        s.iterations += s.gradients->solve(X);
        return;
    }
    for_each_index(static_cast<int>(X.rows()), [&](int i) { row_of(X, i) *= s.M[i]; });
    if (s.ready == LinearSolver::distributed) {
        auto columns =
            Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, FourColumns::width, Eigen::RowMajor>>(X.data(), X.rows(), FourColumns::width);
        columns.leftCols(3) = s.ranks->solve(columns.leftCols(3));
        return;
    }
    solve_in_place(s.factor, X);
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
    if (state_->ready == LinearSolver::distributed) return state_->ranks->nonzeros();
    return state_->analysis ? state_->analysis->nonzeros() : 0;
}

int ImplicitSolver::analyses() const { return state_->analyses; }
int ImplicitSolver::factorisations() const { return state_->factorisations; }
long long ImplicitSolver::iterations() const { return state_->iterations; }

}   // namespace meshfolio
