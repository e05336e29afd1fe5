#include <memory>

#include "base/number_text.h"
#include "cli/commands.h"
#include "geometry/distributed/backend.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/definiteness.h"
#include "geometry/spectrum/stability.h"
#include "mesh/io/mesh_files.h"
#include "mesh/triangle_measures.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/one_mesh/fields.h"
#include "run/progress.h"

namespace meshfolio::cli {

namespace {

struct SmoothFlags {
    std::string mesh, output, scheme = "explicit", laplacian = "cotan", backend = "builtin", lambda, unit = "raw", mu, iterations = "1";
    bool rebuild = false, adaptive = false;
};

/// Returns all options except the step, which needs the mesh.
SmoothingOptions smoothing_options(const SmoothFlags& options) {
    SmoothingOptions smoothing;
    smoothing.scheme = smoothing_scheme_named(options.scheme);
    smoothing.laplacian = operator_named(options.laplacian);
    smoothing.iterations = static_cast<int>(integer_between("--iterations", options.iterations, 0, 1000000));
    smoothing.rebuild = options.rebuild;
    const bool is_explicit = smoothing.scheme == SmoothingScheme::explicit_euler;
    if (options.adaptive && !is_explicit)
        throw UsageError("--adaptive is for --scheme explicit", "leave it off: only explicit steps have a limit");
    if (options.backend != "builtin" && smoothing.scheme != SmoothingScheme::implicit_euler)
        throw UsageError("--backend " + options.backend + " is for --scheme implicit", "leave it off: only implicit steps have a factor");
    smoothing.adaptive = options.adaptive ? 0.95 : 0;
    smoothing.monitor = is_explicit && options.rebuild;
    if (!options.mu.empty()) smoothing.taubin_mu = finite_number("--mu", options.mu);
    if (!options.lambda.empty()) smoothing.lambda = number_above_zero("--lambda", options.lambda);
    if (is_dimensionless(smoothing.laplacian) && step_unit_named(options.unit) == StepUnit::h2)
        throw UsageError("--unit h2 makes no sense with --operator " + options.laplacian + ", whose lambda has no unit", "use raw or tau");
    return smoothing;
}

/// Warns of an operator with a negative eigenvalue, which has no stable step. Returns true if such an eigenvalue is proved.
bool warn_of_indefinite(const SmoothFlags& options, const SmoothingOptions& smoothing, const TriangleMesh& mesh) {
    const LaplaceBeltrami laplacian = laplace_operator(mesh, smoothing.laplacian);
    const Definiteness found = definiteness(laplacian, assembly_of(smoothing.laplacian));
    if (found.semidefinite()) return false;
    const std::string about = "--operator " + options.laplacian + " on this mesh ";
    if (!found.indefinite()) {
        warn(about + "cannot be proved free of growing modes: its smallest eigenvalue lies between " +
             plain_text(rounded_down(found.mu_low, 3), 3) + " and " + plain_text(rounded_up(found.mu_high, 3), 3));
        return false;
    }
    std::string text = about + "is indefinite: smallest eigenvalue " + plain_text(rounded_up(found.mu_high, 4), 4) +
                       " or less, at vertex " + std::to_string(found.bottom.vertex);
    if (smoothing.scheme == SmoothingScheme::explicit_euler) {
        text += "; no step is stable: each of " + plain_text(smoothing.lambda, 4) + " multiplies that mode by " +
                plain_text(found.growth(smoothing.lambda), 6);
    } else if (smoothing.scheme == SmoothingScheme::taubin) {
        const double back = taubin_mu_of(laplacian, smoothing);
        text += "; each iteration multiplies that mode by " +
                plain_text((1 - smoothing.lambda * found.mu_high) * (1 - back * found.mu_high), 6);
    } else {
        text += smoothing.lambda * -found.mu_high < 1
                    ? "; each step multiplies that mode by " + plain_text(1 / (1 + smoothing.lambda * found.mu_high), 6) + " or more"
                    : "; M - lambda C is not positive definite";
    }
    warn(text + "; take --operator cotan or idt");
    return true;
}

/// Returns the step in model units. Computes the largest stable step only if it is needed.
double step_of(const SmoothFlags& options, const SmoothingOptions& smoothing, const PreparedMesh& prepared) {
    const StepUnit unit = step_unit_named(options.unit);
    const bool is_explicit = smoothing.scheme == SmoothingScheme::explicit_euler;
    const Stage stage("largest stable step");
    const bool needs_limit = is_explicit || unit == StepUnit::tau || options.lambda.empty();
    const double critical = needs_limit ? largest_stable_step(largest_eigenvalue(laplace_operator(prepared.mesh, smoothing.laplacian))) : 0;
    if (options.lambda.empty()) {
        warn("no --lambda given; taking " + plain_text(0.5 * critical) +
             " (1/mu_max, half the largest stable step, in squared model units)");
        return 0.5 * critical;
    }
    const double step = step_in_model_units(smoothing.lambda, unit, critical, mean_edge_length(prepared.mesh));
    if (is_explicit && !options.adaptive && step > critical) {
        warn("lambda = " + plain_text(step) + " is beyond the largest stable step of " + plain_text(critical) +
             "; the highest modes will grow");
    }
    return step;
}

/// Warns if a rebuilt operator made the step unstable, or if steps were cut.
void warn_of_limit(const SmoothingOptions& smoothing, const Smoothed& result) {
    if (result.crossing_iteration > 0) {
        const StepStability& step = result.steps[static_cast<std::size_t>(result.crossing_iteration) - 1];
        warn("lambda mu_max = " + plain_text(step.top, 4) + " is beyond 2 in iteration " + std::to_string(result.crossing_iteration) +
             ", at vertex " + std::to_string(result.crossing_vertex) + "; take a smaller --lambda or --adaptive");
    }
    if (!(smoothing.adaptive > 0)) return;
    const double asked = smoothing.lambda * smoothing.iterations;
    if (result.time < asked * (1 - 1e-12))
        warn("steps were cut below 2/mu_max: diffusion time " + plain_text(result.time) + " of " + plain_text(asked) + " reached");
}

ExitCode run_smooth(const SmoothFlags& options, const Backend& backend) {
    SmoothingOptions smoothing = smoothing_options(options);
    smoothing.factor_remotely = backend.factor;
    check_output("-o", options.output, mesh_or_standard_output());
    const PreparedMesh prepared = load_mesh(options.mesh, Checks::all, Keep::attributes);
    bool indefinite = false;
    const Smoothed result = about_mesh(options.mesh, [&] {
        smoothing.lambda = step_of(options, smoothing, prepared);
        indefinite = warn_of_indefinite(options, smoothing, prepared.mesh);
        if (smoothing.scheme == SmoothingScheme::taubin) {
            const TaubinGrowth growth = taubin_growth(laplace_operator(prepared.mesh, smoothing.laplacian), smoothing);
            const std::string text = growth.warning(smoothing.iterations);
            const char* remedy =
                growth.of_highest_mode ? "; take a smaller --lambda" : "; take fewer --iterations, or --mu nearer to -lambda";
            if (!text.empty()) warn(text + remedy);
        }
        return smooth(prepared.mesh, smoothing);
    });
    if (result.solver == LinearSolver::conjugate_gradients) {
        warn("a factor would not fit into memory; " + std::to_string(result.solver_iterations) +
             " iterations of conjugate gradients made the " + std::to_string(result.iterations) + " steps instead");
    }
    write_mesh_to(options.output, moved_to(prepared.mesh, result.X), prepared.attributes);
    warn_of_limit(smoothing, result);
    if (result.collapse_iteration > 0) {
        complain(shown(options.mesh) + ": nothing was left of the surface before iteration " + std::to_string(result.collapse_iteration) +
                 "; " + options.output + " has the last positions; take fewer --iterations or a smaller --lambda");
        return ExitCode::failed;
    }
    if (!result.blew_up) return ExitCode::ok;
    complain(shown(options.mesh) + ": blew up in iteration " + std::to_string(result.blow_up_iteration) + " at vertex " +
             std::to_string(result.blow_up_vertex) + "; " + options.output + " has the last finite positions; take " +
             (indefinite                                            ? "--operator cotan or idt"
              : smoothing.scheme == SmoothingScheme::implicit_euler ? "a smaller --lambda"
                                                                    : "a smaller --lambda or --scheme implicit"));
    return ExitCode::failed;
}

}   // namespace

Command smooth_command(CLI::App& parent) {
    const auto options = std::make_shared<SmoothFlags>();
    CommandOptions app(parent, "smooth", "One Laplacian smoothing run");
    app.required("MESH", options->mesh, formats_read);
    app.required("-o,--output FILE", options->output, formats_written);
    app.choice("--scheme", options->scheme, {"explicit", "implicit", "taubin"}, "scheme of a step");
    app.choice("--operator", options->laplacian, operator_choices(), "Laplace-Beltrami operator");
    app.choice("--backend", options->backend, backend_choices(),
               "library that factors implicit steps; slepc: all ranks of mpirun together");
    app.text("--lambda", options->lambda, "step; default: half the largest stable one");
    app.choice("--unit", options->unit, {"raw", "tau", "h2"},
               "of the step: raw (an area), tau (1 is the largest stable step), h2 (mean edge squared)");
    app.text("--mu", options->mu, "Taubin's negative step, in model units; default: from pass-band 0.1");
    app.text("--iterations", options->iterations, "number of steps");
    app.flag("--rebuild", options->rebuild, "assemble the operator at every step; default: once, of the input");
    app.flag("--adaptive", options->adaptive, "cut explicit steps below 2 over a proved bound of mu_max");
    app.footer(std::string(attributes_are_kept) +
               "Example: meshfolio smooth fandisk.obj -o fair.ply --scheme implicit --lambda 5 --unit tau --iterations 10");
    return {app,
            [options] { return with_backend(options->backend, [&](const Backend& backend) { return run_smooth(*options, backend); }); }};
}

}   // namespace meshfolio::cli
