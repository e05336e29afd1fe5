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

/// Returns the scheme named "explicit", "implicit" or "taubin". @throws UsageError for other names
SmoothingScheme smoothing_scheme_named(const std::string& name);

struct SmoothingOptions {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    OperatorKind laplacian = OperatorKind::cotan;
    double lambda = 0;      // step [length²]; dimensionless for the uniform operator
    double taubin_mu = 0;   // negative step of Taubin; 0: from the pass-band 1/λ + 1/μ = pass_band · μ_max/2
    double pass_band = 0.1;
    int iterations = 1;
    bool rebuild = false;   // true: L of the current positions at every step; false: L of the input
    AreaForm area = AreaForm::barycentric;
    /// Stores λμ_max of every step, by Lanczos, in Smoothed::steps. Explicit scheme only.
    bool monitor = false;
    /// 0: every step is λ. In (0, 1]: steps are cut to this share of 2/bound, the Gershgorin bound of the current operator, so that no mode
    /// with μ ≥ 0 can grow for any λ (definiteness.h: modes with μ < 0). Explicit scheme only.
    double adaptive = 0;
    /// The memory limit of a factor; 0: the available memory. Beyond it, implicit steps use conjugate gradients. [bytes]
    double memory_limit = 0;
    FactorRemotely factor_remotely = {};   // for implicit steps, without that limit; empty: in this process
    double blow_up_at = 1e3;               // stop when a vertex is farther than this many box diagonals from the centre
    /// Called after every iteration with its number (from 1) and the positions; return false to stop.
    std::function<bool(int, const Positions&)> after_step = {};
};

/// One explicit step beside its limit: it multiplies the top mode of its operator by 1 − λμ_max.
struct StepStability {
    double lambda = 0;   // the step taken, in the unit of SmoothingOptions::lambda
    double bound = 0;    // λ times the Gershgorin bound: proved ≥ λμ_max
    double top = 0;      // λμ_max by Lanczos; NaN where not monitored, or where weights are not finite
    int vertex = -1;     // where the top mode is largest; −1 if not known
};

struct Smoothed {
    Positions X;                  // the last finite positions
    int iterations = 0;           // iterations done
    bool blew_up = false;         // NaN, infinity, or beyond blow_up_at
    int blow_up_iteration = 0;    // 0: none
    int blow_up_vertex = -1;      // the first to do so; −1: none
    int collapse_iteration = 0;   // with `rebuild`: the iteration not done because the surface had collapsed; 0: none
    double taubin_mu = 0;         // the μ used by Taubin
    double time = 0;              // diffusion time, the sum of all steps taken [as λ]
    /// One entry an iteration, including the one that blew up, when monitored or adaptive; else empty.
    std::vector<StepStability> steps;
    int crossing_iteration = 0;   // when monitored: the first with λμ_max > 2; 0: none
    int crossing_vertex = -1;     // where its top mode is largest
    // Implicit scheme only:
    LinearSolver solver = LinearSolver::none;   // the solver of the last step
    long long factor_nonzeros = 0;              // of the last factor
    int analyses = 0, factorisations = 0;       // in this run: symbolic, numerical
    long long solver_iterations = 0;            // of conjugate gradients, summed over the steps
};

/// Smooths the mesh by options.iterations steps, fewer if it blows up. Vertices without mass stay. With `rebuild`, the run ends when the
/// surface has shrunk to points or lines.
/// @throws MeshError for λ that is not finite or ≤ 0, iterations < 0, adaptive outside [0, 1], or a limit asked of another scheme than
///         the explicit one; SolverError if M − λC cannot be factored
Smoothed smooth(const TriangleMesh& mesh, const SmoothingOptions& options);
/// Smooths the mesh as smooth(mesh, options), with a solver shared by several runs, which keeps implicit factors from one to the next.
Smoothed smooth(const TriangleMesh& mesh, const SmoothingOptions& options, ImplicitSolver& solver);

/// Returns Taubin's negative step μ with this operator: options.taubin_mu if not 0, else from 1/λ + 1/μ = pass_band · μ_max/2.
/// @throws MeshError if λ is too large for the pass-band
double taubin_mu_of(const LaplaceBeltrami& laplacian, const SmoothingOptions& options);

/// The largest factor |(1 − λμ)(1 − mμ)| of one Taubin iteration over all μ in [0, μ_max]; above 1 modes grow.
struct TaubinGrowth {
    double factor = 1;              // at least 1, the factor of constants
    double mu = 0;                  // of that factor [1/length²]
    bool of_highest_mode = false;   // true: at μ_max, λ is too large; false: in the pass-band, which every |m| > λ raises

    /// Returns a sentence if the highest mode grows at all, or if modes of the pass-band grow by more than 20 %; else "".
    std::string warning(int iterations) const;
};
/// Computes the growth of one Taubin iteration for options.lambda and taubin_mu_of(). @throws MeshError as taubin_mu_of()
TaubinGrowth taubin_growth(const LaplaceBeltrami& laplacian, const SmoothingOptions& options);

/// Returns X + λLX, n × 3, one explicit step with a fixed operator; vertices without mass stay.
Positions explicit_step(const LaplaceBeltrami& laplacian, double lambda, const Positions& X);
/// Returns the solution X' of (M − λC)X' = MX, n × 3, one implicit step; vertices without mass stay.
Positions implicit_step(const LaplaceBeltrami& laplacian, double lambda, const Positions& X);

}   // namespace meshfolio
