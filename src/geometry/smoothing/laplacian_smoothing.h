/// @file
/// Diffusion flow on meshes, ∂X/∂t = LX: explicit, implicit (Desbrun et al. 1999, eq. 9), or as the λ|μ low-pass filter of Taubin 1995.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/implicit_solver.h"

namespace meshfolio {

enum class SmoothingScheme { explicit_euler, implicit_euler, taubin };

SmoothingScheme smoothing_scheme_named(const std::string& name);   // explicit, implicit, taubin

struct SmoothingOptions {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    OperatorKind laplacian = OperatorKind::cotan;
    double lambda = 0;      // step [length²]; dimensionless for the uniform operator
    double taubin_mu = 0;   // negative step of Taubin; 0: from the pass-band 1/λ + 1/μ = pass_band · μ_max/2
    double pass_band = 0.1;
    int iterations = 1;
    bool rebuild = false;   // L from the current positions at every step; default: L of the input
    AreaForm area = AreaForm::barycentric;
    /// λμ_max of every step into Smoothed::steps, by Lanczos. Explicit scheme only.
    bool monitor = false;
    /// 0: every step is λ. In (0, 1]: steps are cut to this share of 2/bound, bound that of Gershgorin for the operator at hand, so that no
    /// mode with μ ≥ 0 can grow, whatever λ (definiteness.h: what of those below 0). Explicit scheme only.
    double adaptive = 0;
    /// What a factor may take; 0: what the machine has left. Beyond it, implicit steps are made by conjugate gradients. [bytes]
    double memory_limit = 0;
    FactorRemotely factor_remotely = {};   // of implicit steps, without that limit; empty: here
    double blow_up_at = 1e3;               // stop when a vertex is farther than this many box diagonals from the centre
    /// Called after every iteration with its number (from 1) and the positions; return false to stop.
    std::function<bool(int, const Positions&)> after_step = {};
};

/// One explicit step beside its limit: the top mode of the operator it uses is multiplied by 1 − λμ_max.
struct StepStability {
    double lambda = 0;   // the step taken, in the unit of SmoothingOptions::lambda
    double bound = 0;    // λ times the Gershgorin bound: proved ≥ λμ_max
    double top = 0;      // λμ_max by Lanczos; NaN where not monitored, or where weights are not finite
    int vertex = -1;     // where the top mode is largest; −1 where that is not known
};

struct Smoothed {
    Positions X;                  // the last finite positions
    int iterations = 0;           // done
    bool blew_up = false;         // NaN, infinity, or beyond blow_up_at
    int blow_up_iteration = 0;    // when
    int blow_up_vertex = -1;      // and where first
    int collapse_iteration = 0;   // the one not done because nothing was left of the surface, when rebuilt; 0: none
    double taubin_mu = 0;         // the μ used by Taubin
    double time = 0;              // diffusion time, the sum of all steps taken [as λ]
    /// One an iteration, the one that blew up included, when monitored or adaptive; else empty.
    std::vector<StepStability> steps;
    int crossing_iteration = 0;   // the first with λμ_max > 2, when monitored; 0: none
    int crossing_vertex = -1;     // where its top mode is largest
    // Implicit only:
    LinearSolver solver = LinearSolver::none;   // that made the last step
    long long factor_nonzeros = 0;              // of the last factorisation
    int analyses = 0, factorisations = 0;       // made in this run: symbolic, numerical
    long long solver_iterations = 0;            // of conjugate gradients, all steps together
};

/// One run. Vertices without mass stay. Where the operator is rebuilt, the run ends once the surface has shrunk to points or lines.
/// @throws MeshError for λ that is not finite or ≤ 0, iterations < 0, adaptive outside [0, 1], or a limit asked of another scheme than
///         the explicit one; SolverError if M − λC cannot be factored
Smoothed smooth(const TriangleMesh& mesh, const SmoothingOptions& options);
/// The same for one of several runs: the implicit scheme takes from the solver what an earlier run left there, and leaves its own.
Smoothed smooth(const TriangleMesh& mesh, const SmoothingOptions& options, ImplicitSolver& solver);

/// Taubin's negative step μ with that operator: the one given, else 1/λ + 1/μ = pass_band · μ_max/2.
/// @throws MeshError if λ is too large for the pass-band
double taubin_mu_of(const LaplaceBeltrami& laplacian, const SmoothingOptions& options);

/// The largest factor |(1 − λμ)(1 − mμ)| of an iteration of Taubin's over all μ in [0, μ_max]: beyond 1 modes grow.
struct TaubinGrowth {
    double factor = 1;              // 1 at least, that of constants
    double mu = 0;                  // where [1/length²]
    bool of_highest_mode = false;   // μ = μ_max, where λ is too large; else in the pass-band, which every |m| > λ raises

    /// A sentence where that is to be known: the highest mode grows at all, or modes of the pass-band, where there are any, by 20 % and
    /// more. Else empty.
    std::string warning(int iterations) const;
};
/// @throws MeshError as above
TaubinGrowth taubin_growth(const LaplaceBeltrami& laplacian, const SmoothingOptions& options);

/// X + λLX for a fixed operator, and the solution of (M − λC)X' = MX: the two steps on their own, for tests and studies.
Positions explicit_step(const LaplaceBeltrami& laplacian, double lambda, const Positions& X);
Positions implicit_step(const LaplaceBeltrami& laplacian, double lambda, const Positions& X);

}   // namespace meshfolio
