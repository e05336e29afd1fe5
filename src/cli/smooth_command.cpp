#include <cmath>
#include <memory>

#include "cli/commands.h"
#include "cli/console.h"
#include "geometry/laplacian_smoothing.h"
#include "geometry/stability.h"
#include "geometry/uniform_laplacian.h"
#include "mesh/mesh_files.h"
#include "mesh/triangle_measures.h"
#include "number_text.h"

namespace meshfolio::cli {

namespace {

struct Options {
    std::string mesh, output, scheme = "explicit", laplacian = "cotan", unit = "raw";
    double lambda = 0, mu = 0;
    bool has_lambda = false, rebuild = false;
    int iterations = 1;
};

double critical_step(const PreparedMesh& prepared, SmoothingOperator laplacian) {
    if (laplacian == SmoothingOperator::cotangent) return largest_stable_step(largest_eigenvalue(laplace_beltrami(prepared.mesh)));
    Vector valence(prepared.mesh.vertex_count());
    for (int v = 0; v < valence.size(); ++v) valence[v] = prepared.topology.neighbours.size(v);
    return largest_stable_step(largest_eigenvalue_uniform(uniform_laplacian(prepared.topology), valence));
}

SmoothingOptions smoothing_options(const Options& options, const PreparedMesh& prepared) {
    SmoothingOptions smoothing;
    smoothing.scheme = smoothing_scheme_named(options.scheme);
    smoothing.laplacian = smoothing_operator_named(options.laplacian);
    smoothing.iterations = options.iterations;
    smoothing.rebuild = options.rebuild;
    smoothing.taubin_mu = options.mu;
    const StepUnit unit = step_unit_named(options.unit);
    if (smoothing.laplacian == SmoothingOperator::uniform && unit == StepUnit::h2) {
        throw UsageError("--unit h2 makes no sense with --operator uniform, whose lambda has no unit", "use raw or tau");
    }
    const double critical = critical_step(prepared, smoothing.laplacian);
    if (options.has_lambda) {
        smoothing.lambda = step_in_model_units(options.lambda, unit, critical, mean_edge_length(prepared.mesh));
    } else {
        smoothing.lambda = 0.5 * critical;
        warn("no --lambda given; half the largest stable step is taken, " + plain_text(smoothing.lambda));
    }
    if (smoothing.scheme == SmoothingScheme::explicit_euler && smoothing.lambda > critical) {
        warn("lambda = " + plain_text(smoothing.lambda) + " is beyond the largest stable step of " + plain_text(critical) +
             "; the highest modes will grow");
    }
    return smoothing;
}

ExitCode run_smooth(const Options& options) {
    const PreparedMesh prepared = load_mesh(options.mesh);
    const SmoothingOptions smoothing = smoothing_options(options, prepared);
    const Smoothed result = smooth(prepared.mesh, smoothing);
    write_mesh(options.output, moved_to(prepared.mesh, result.X));
    if (!result.blew_up) return ExitCode::ok;
    complain(options.mesh + ": blew up in iteration " + std::to_string(result.blow_up_iteration) + " at vertex " +
             std::to_string(result.blow_up_vertex) + "; " + options.output +
             " has the last finite positions; take a smaller --lambda or --scheme implicit");
    return ExitCode::failed;
}

}   // namespace

Command smooth_command(CLI::App& parent) {
    const auto options = std::make_shared<Options>();
    CLI::App* app = parent.add_subcommand("smooth", "One Laplacian smoothing run");
    app->add_option("MESH", options->mesh, "OBJ, OFF, PLY or STL")->required();
    app->add_option("-o,--output", options->output, "OBJ, OFF or PLY")->required();
    app->add_option("--scheme", options->scheme, "explicit, implicit or taubin")->capture_default_str();
    app->add_option("--operator", options->laplacian, "cotan or uniform")->capture_default_str();
    CLI::Option* lambda = app->add_option("--lambda", options->lambda, "step; default: half the largest stable one");
    app->add_option("--unit", options->unit, "of the step: raw (an area), tau (1 is the largest stable step), h2 (mean edge squared)")
        ->capture_default_str();
    app->add_option("--mu", options->mu, "Taubin's negative step, in model units; default: from pass-band 0.1");
    app->add_option("--iterations", options->iterations, "how many")->capture_default_str()->check(CLI::Range(0, 1000000));
    app->add_flag("--rebuild", options->rebuild, "operator of the current positions at every step; default: of the input");
    app->footer("Example: meshfolio smooth fandisk.obj -o fair.ply --scheme implicit --lambda 5 --unit tau --iterations 10");
    return {app, [options, lambda] {
                options->has_lambda = lambda->count() > 0;
                return run_smooth(*options);
            }};
}

}   // namespace meshfolio::cli
