#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "base/number_text.h"
#include "cli/commands.h"
#include "geometry/distributed/backend.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/definiteness.h"
#include "geometry/spectrum/stability.h"
#include "mesh/io/mesh_files.h"
#include "mesh/triangle_measures.h"
#include "output/draw/write_drawing.h"
#include "questions/bench/smoothing_study.h"
#include "report/writers.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/smoothing_trace.h"
#include "run/progress.h"

namespace meshfolio::cli {

namespace {

struct SmoothFlags {
    std::string mesh, output, scheme = "explicit", laplacian = "cotan", backend = "builtin", lambda, unit = "raw", mu, iterations = "1";
    std::string trace, csv, plot, curve, summary, frames, unit_of;
    bool rebuild = false, adaptive = false, keep_reached = false;

    /// Returns the steps as they are written; "" for the default.
    std::vector<std::string> lambdas() const { return lambda.empty() ? std::vector<std::string>{""} : split(lambda, ','); }
};

/// Returns all options; the step in the unit of the flags, which may need the mesh.
/// @param lambda  as it is written; empty: the default, 0
SmoothingOptions smoothing_options(const SmoothFlags& options, const std::string& lambda) {
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
    if (!lambda.empty()) smoothing.lambda = number_above_zero("--lambda", lambda);
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

/// Warns if an iteration of Taubin makes modes grow.
void warn_of_growth(const SmoothingOptions& smoothing, const TriangleMesh& mesh) {
    const TaubinGrowth growth = taubin_growth(laplace_operator(mesh, smoothing.laplacian), smoothing);
    const std::string text = growth.warning(smoothing.iterations);
    const char* remedy = growth.of_highest_mode ? "; take a smaller --lambda" : "; take fewer --iterations, or --mu nearer to -lambda";
    if (!text.empty()) warn(text + remedy);
}

/// Returns why a run ended early and what to do; "" if it did not. @param file  that has the positions reached; empty: none
std::string early_end(const SmoothingOptions& smoothing, const Smoothed& result, const std::string& file, bool indefinite) {
    const std::string kept = file.empty() ? "" : "; " + file + " has the last" + (result.blew_up ? " finite" : "") + " positions";
    if (result.collapse_iteration > 0)
        return "nothing was left of the surface before iteration " + std::to_string(result.collapse_iteration) + kept +
               "; take fewer --iterations or a smaller --lambda";
    if (!result.blew_up) return "";
    return "blew up in iteration " + std::to_string(result.blow_up_iteration) + " at vertex " + std::to_string(result.blow_up_vertex) +
           kept + "; take " +
           (indefinite                                            ? "--operator cotan or idt"
            : smoothing.scheme == SmoothingScheme::implicit_euler ? "a smaller --lambda"
                                                                  : "a smaller --lambda or --scheme implicit");
}

/// Returns the file with words before its ending: "fair_10.ply".
std::string with_suffix(const std::string& file, const std::string& suffix) {
    const std::filesystem::path path = file;
    return (path.parent_path() / (path.stem().string() + suffix + path.extension().string())).string();
}

/// The runs of one command, one for each λ.
class SmoothRuns {
public:
    SmoothRuns(const SmoothFlags& flags, const Backend& backend) : flags_(flags), backend_(backend) {
        check_options();
        frames_ = integers_between("--frames", flags.frames, 0, smoothing_options(flags, "").iterations);
        prepared_ = load_mesh(flags.mesh, Checks::all, Keep::attributes);
        for (const auto& [file, mesh] : {std::pair{&flags.trace, &clean_}, {&flags.unit_of, &unit_mesh_}}) {
            if (file->empty()) continue;
            *mesh = load_mesh(*file);
            files_.keep(*file);
        }
        if (clean_) about_mesh(flags.trace, [&] { return vertex_rms(clean_->mesh.X, prepared_.mesh.X); });   // throws
    }

    ExitCode run() {
        for (const std::string& lambda : flags_.lambdas()) run_one(lambda);
        const std::string curve = !flags_.curve.empty() ? flags_.curve : clean_ ? "error" : "energy";
        if (!flags_.csv.empty()) print_to(files_, flags_.csv, write_csv(table_of(traces_)));
        if (!flags_.summary.empty()) print_to(files_, flags_.summary, write_csv(summary_of(traces_)));
        if (!flags_.plot.empty()) files_.add(flags_.plot, output::with_fonts(report::svg_on_white(svg_of(plot_of(traces_, curve)))));
        files_.publish();
        if (meshes_.size() > 1 && flags_.csv != "-" && flags_.summary != "-")
            for (const std::string& file : meshes_) print_path(file);
        for (const std::string& message : early_ends_)
            if (flags_.keep_reached) warn(message);
            else complain(message, Ink::red);
        return early_ends_.empty() || flags_.keep_reached ? ExitCode::ok : ExitCode::failed;
    }

private:
    const SmoothFlags& flags_;
    const Backend& backend_;
    std::vector<int> frames_;
    PreparedMesh prepared_;
    std::optional<PreparedMesh> clean_, unit_mesh_;
    std::map<const PreparedMesh*, double> limits_;   // the largest stable steps computed so far
    output::FileGroup files_;
    std::vector<SmoothingTrace> traces_;
    std::vector<std::string> meshes_, early_ends_;   // files written; messages

    void check_options() const {
        const std::vector<std::string> lambdas = flags_.lambdas();
        for (const std::string& lambda : lambdas) {
            smoothing_options(flags_, lambda);   // throws
            if (std::ranges::count(lambdas, lambda) > 1) throw UsageError("--lambda " + lambda + " is given twice", "give it once");
        }
        if (flags_.output.empty() && !measures())
            throw UsageError("-o is required without --csv, --plot and --summary", "name a file for the result");
        if (flags_.output.empty() && !flags_.frames.empty())
            throw UsageError("--frames needs -o", "name a file; frames get its name and a number");
        if (flags_.output == "-" && (lambdas.size() > 1 || !flags_.frames.empty()))
            throw UsageError("several meshes cannot be written to standard output", "name a file by -o");
        const std::vector<std::string> files{flags_.output, flags_.csv, flags_.summary};
        if (std::ranges::count(files, "-") > 1)
            throw UsageError("-o, --csv and --summary cannot share standard output", "name files for all but one of them");
        if (!measures() && !flags_.trace.empty())
            throw UsageError("--trace needs --csv, --plot or --summary", "name a file for the errors");
        if (flags_.curve == "error" && flags_.trace.empty()) throw UsageError("--curve error needs --trace", "name the clean mesh");
        check_read_once(flags_.mesh, flags_.trace);
        check_output("-o", flags_.output, mesh_or_standard_output());
        check_output("--csv", flags_.csv, {".csv", "-"});
        check_output("--summary", flags_.summary, {".csv", "-"});
        check_output("--plot", flags_.plot, {".svg"});
    }

    bool measures() const { return !flags_.csv.empty() || !flags_.plot.empty() || !flags_.summary.empty(); }

    double limit_of(const PreparedMesh& mesh, OperatorKind laplacian) {
        const auto [limit, is_new] = limits_.try_emplace(&mesh);
        const Stage stage("largest stable step");
        if (is_new) limit->second = largest_stable_step(largest_eigenvalue(laplace_operator(mesh.mesh, laplacian)));
        return limit->second;
    }

    /// Returns the step in model units. Computes a largest stable step only if it is needed.
    double step_of(const SmoothingOptions& smoothing) {
        const StepUnit unit = step_unit_named(flags_.unit);
        const PreparedMesh& unit_mesh = unit_mesh_ ? *unit_mesh_ : prepared_;
        const auto limit = [&](const PreparedMesh& mesh) { return limit_of(mesh, smoothing.laplacian); };
        if (flags_.lambda.empty()) {
            const double half = 0.5 * limit(unit_mesh);
            warn("no --lambda given; taking " + plain_text(half) + " (1/mu_max, half the largest stable step, in squared model units)");
            return half;
        }
        const double step =
            step_in_model_units(smoothing.lambda, unit, unit == StepUnit::tau ? limit(unit_mesh) : 0, mean_edge_length(unit_mesh.mesh));
        const bool is_limited = smoothing.scheme == SmoothingScheme::explicit_euler && !flags_.adaptive;
        if (is_limited && step > limit(prepared_)) {
            warn("lambda = " + plain_text(step) + " is beyond the largest stable step of " + plain_text(limit(prepared_)) +
                 "; the highest modes will grow");
        }
        return step;
    }

    void add_result(const std::string& file, const Positions& X) {
        add_mesh(files_, file, moved_to(prepared_.mesh, X), prepared_.attributes);
        meshes_.push_back(file);
    }

    void run_one(const std::string& lambda) {
        const bool is_one = flags_.lambdas().size() == 1;
        const std::string file = is_one || flags_.output.empty() ? flags_.output : with_suffix(flags_.output, "_" + lambda);
        SmoothingOptions smoothing = smoothing_options(flags_, lambda);
        smoothing.factor_remotely = backend_.factor;
        SmoothingTrace trace{.lambda = lambda};
        std::size_t frames = 0;   // written
        bool indefinite = false;
        const Smoothed result = about_mesh(flags_.mesh, [&] {
            smoothing.lambda = step_of(smoothing);
            indefinite = warn_of_indefinite(flags_, smoothing, prepared_.mesh);
            if (smoothing.scheme == SmoothingScheme::taubin) warn_of_growth(smoothing, prepared_.mesh);
            std::optional<LaplaceBeltrami> laplacian;   // of the measures
            if (measures()) laplacian = laplace_operator(prepared_.mesh, smoothing.laplacian);
            const auto look = [&](int iteration, const Positions& X) {
                if (laplacian) measure(prepared_, *laplacian, clean_ ? &clean_->mesh : nullptr, X, trace);
                if (std::ranges::count(frames_, iteration) == 0) return true;
                add_result(with_suffix(file, "_" + std::to_string(iteration)), X);
                ++frames;
                return true;
            };
            look(0, prepared_.mesh.X);
            if (laplacian || !frames_.empty()) smoothing.after_step = look;
            ImplicitSolver solver;
            return flags_.keep_reached ? smooth_until_collapse(prepared_.mesh, smoothing, solver)
                                       : smooth(prepared_.mesh, smoothing, solver);
        });
        if (frames < frames_.size()) warn(std::to_string(frames_.size() - frames) + " of the --frames were not reached");
        if (result.solver == LinearSolver::conjugate_gradients) {
            warn("a factor would not fit into memory; " + std::to_string(result.solver_iterations) +
                 " iterations of conjugate gradients made the " + std::to_string(result.iterations) + " steps instead");
        }
        if (!file.empty()) add_result(file, result.X);
        warn_of_limit(smoothing, result);
        trace.time = times_of(result);
        trace.end = result.collapse_iteration > 0 ? "collapsed" : result.blew_up ? "blew up" : "whole";
        if (!flags_.summary.empty()) {
            trace.share = smoothing.lambda / limit_of(prepared_, smoothing.laplacian);
            trace.moved = 100 * vertex_rms(prepared_.mesh.X, result.X) / bounding_box(prepared_.mesh).diagonal();
        }
        traces_.push_back(std::move(trace));
        const std::string end = early_end(smoothing, result, file, indefinite);
        if (!end.empty()) early_ends_.push_back(shown(flags_.mesh) + ": " + (is_one ? "" : "lambda " + lambda + ": ") + end);
    }
};

}   // namespace

Command smooth_command(CLI::App& parent) {
    const auto options = std::make_shared<SmoothFlags>();
    CommandOptions app(parent, "smooth", "One Laplacian smoothing run");
    app.required("MESH", options->mesh, formats_read);
    app.text("-o,--output FILE", options->output, std::string("required without --csv, --plot and --summary; ") + formats_written);
    app.choice("--scheme", options->scheme, {"explicit", "implicit", "taubin"}, "scheme of a step");
    app.choice("--operator", options->laplacian, operator_choices(), "Laplace-Beltrami operator");
    app.choice("--backend", options->backend, backend_choices(),
               "library that factors implicit steps; slepc: all ranks of mpirun together");
    app.text("--lambda", options->lambda,
             "step; default: half the largest stable one; several, with commas: as many runs, to <file>_<step>");
    app.choice("--unit", options->unit, {"raw", "tau", "h2"},
               "of the step: raw (an area), tau (1 is the largest stable step), h2 (mean edge squared)");
    app.text("--unit-of MESH", options->unit_of, "the mesh that tau and h2 are measured on; default: the input");
    app.text("--mu", options->mu, "Taubin's negative step, in model units; default: from pass-band 0.1");
    app.text("--iterations", options->iterations, "number of steps");
    app.flag("--rebuild", options->rebuild, "assemble the operator at every step; default: once, of the input");
    app.flag("--adaptive", options->adaptive, "cut explicit steps below 2 over a proved bound of mu_max");
    app.text("--csv FILE", options->csv, "time, energy, area, volume after every iteration; - for standard output");
    app.text("--trace CLEAN", options->trace, "a mesh to measure against: adds the rms error, in % of its box diagonal");
    app.text("--plot FILE", options->plot, "a measure against the iterations, .svg: the error with --trace, else the energy");
    app.choice("--curve", options->curve, trace_measures, "another measure for --plot");
    app.text(
        "--summary FILE", options->summary,
        "a row for each step: its share of the largest stable one, iterations, end, what is left, moved, error; - for standard output");
    app.text("--frames NUMBERS", options->frames, "also write the surface after these iterations, 0,10,50, to <file>_<iteration>");
    app.flag("--keep-reached", options->keep_reached, "exit code 0 and a warning if a run collapses or blows up; its files end there");
    app.footer(std::string(attributes_are_kept) +
               "Example: meshfolio smooth fandisk.obj -o fair.ply --scheme implicit --lambda 5 --unit tau --iterations 10");
    return {app, [options] {
                return with_backend(options->backend, [&](const Backend& backend) { return SmoothRuns(*options, backend).run(); });
            }};
}

}   // namespace meshfolio::cli
