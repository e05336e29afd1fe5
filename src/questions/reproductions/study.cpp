#include "questions/reproductions/parts.h"

#include <Eigen/Geometry>
#include <set>

#include "mesh/vertex_noise.h"

namespace meshfolio::reproductions {

namespace {

constexpr double out_of_bounds = 3;   // box diagonals from the centre: where a step is no longer usable

bool looks_at_noise(const Experiment& experiment) {
    return experiment.kind == ExperimentKind::denoising || experiment.kind == ExperimentKind::error_curve;
}

ExperimentMesh measured(const OriginalMesh& original, SharedMesh used, const Experiment& experiment) {
    ExperimentMesh mesh;
    mesh.originals = {original};
    mesh.used = std::move(used);
    mesh.label = mesh.used->name;
    mesh.stand_in = mesh.used->input.stand_in || mesh.used->input.role != original.name;
    const Box box = bounding_box(mesh.mesh());
    mesh.extent = box.extent();
    mesh.diagonal = box.diagonal();
    mesh.mean_edge = mean_edge_length(mesh.mesh());
    const bool steps = experiment.kind == ExperimentKind::smoothing && experiment.lambda_unit == StepUnit::raw;
    if (steps && mesh.stand_in && original.lambda_crit > 0)
        mesh.cotan_critical = largest_stable_step(largest_eigenvalue(laplace_beltrami(mesh.mesh())));
    return mesh;
}

/// Files of one name from several places, or a mesh and another's stand-in, get numbers.
void tell_apart(std::vector<ExperimentMesh>& meshes) {
    std::set<std::string> taken;
    for (ExperimentMesh& mesh : meshes)
        for (int number = 2; !taken.insert(mesh.label).second; ++number) mesh.label = mesh.used->name + "_" + std::to_string(number);
}

/// Calls `visit` with every combination of mesh, operator, area form, method and λ.
template <class Visit>
void for_each_combination(const Experiment& experiment, const std::vector<ExperimentMesh>& meshes, Visit visit) {
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (const OperatorKind kind : experiment.operators)
            for (const AreaForm area : experiment.areas) {
                const SmoothingSubject subject = smoothing_subject(meshes[m].used, kind, area);
                ImplicitSolver solver;   // one symbolic analysis for all λ
                for (const SmoothingMethod& method : experiment.methods)
                    for (const double lambda : experiment.lambda) visit(m, subject, method, lambda, solver);
            }
}

NoisyRun noisy_run(const ExperimentMesh& mesh, const Experiment& experiment, NoisyRun run, ImplicitSolver& solver) {
    const TriangleMesh& clean = mesh.mesh();
    run.sigma = noise_on(experiment, mesh, run.noise);
    run.noisy = std::make_shared<const TriangleMesh>(moved_to(clean, with_gaussian_noise(clean.X, run.sigma, experiment.seed)));
    run.rms = {vertex_rms(clean.X, run.noisy->X)};
    run.best_X = run.noisy->X;

    SmoothingOptions options{.scheme = run.method.scheme,
                             .laplacian = run.kind,
                             .lambda = run.lambda,
                             .iterations = experiment.iterations.back(),
                             .rebuild = run.method.rebuild,
                             .area = run.area};
    options.after_step = [&](int iteration, const Positions& X) {
        run.rms.push_back(vertex_rms(clean.X, X));
        if (run.rms.back() < run.rms[run.best]) {
            run.best = iteration;
            run.best_X = X;
        }
        if (std::binary_search(experiment.iterations.begin(), experiment.iterations.end(), iteration)) run.snapshots.push_back(X);
        return true;
    };
    const Smoothed result = smooth_until_collapse(*run.noisy, options, solver);
    run.blew_up = result.blew_up;
    run.collapse_iteration = result.collapse_iteration;
    run.blow_up_iteration = result.blow_up_iteration;
    const Positions normals = face_normals(clean);
    run.noisy_angle = mean_normal_angle(normals, face_normals(*run.noisy));
    run.last_angle = mean_normal_angle(normals, face_normals(moved_to(clean, result.X)));
    return run;
}

}   // namespace

std::vector<ExperimentMesh> experiment_meshes(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    std::vector<ExperimentMesh> meshes;
    if (experiment.meshes.empty()) return meshes;
    if (library.has_own_meshes()) {
        for (const auto& own : library.own_meshes()) meshes.push_back(measured(experiment.meshes.front(), own, experiment));
        return meshes;
    }
    for (const OriginalMesh& original : experiment.meshes) {
        const auto used = library.original(original.name, original.file, original.stand_in, settings.base);
        const auto same = std::find_if(meshes.begin(), meshes.end(), [&](const ExperimentMesh& mesh) {
            return mesh.stand_in && used->input.stand_in && mesh.used->input.file == used->input.file;
        });
        if (same != meshes.end())
            same->originals.push_back(original);
        else
            meshes.push_back(measured(original, used, experiment));
    }
    tell_apart(meshes);
    return meshes;
}

Carried lambda_rule(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind) {
    if (!mesh.stand_in || experiment.lambda_unit != StepUnit::raw || is_dimensionless(kind)) return Carried::as_given;
    const OriginalMesh& original = mesh.originals.front();
    if (looks_at_noise(experiment)) return original.mean_edge > 0 ? Carried::by_edge : Carried::as_given;
    return original.lambda_crit > 0 ? Carried::by_limit : Carried::as_given;
}

double lambda_on(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind, double lambda, double critical) {
    const OriginalMesh& original = mesh.originals.front();
    const Carried rule = lambda_rule(experiment, mesh, kind);
    if (rule == Carried::by_limit) return lambda / original.lambda_crit * mesh.cotan_critical;
    if (rule == Carried::by_edge) return lambda * std::pow(mesh.mean_edge / original.mean_edge, 2);
    return step_in_model_units(lambda, experiment.lambda_unit, critical, mesh.mean_edge);
}

Carried noise_rule(const Experiment& experiment, const ExperimentMesh& mesh) {
    const bool carried = mesh.stand_in && experiment.noise_unit == NoiseUnit::raw && mesh.originals.front().mean_edge > 0;
    return carried ? Carried::by_edge : Carried::as_given;
}

Vector3 noise_on(const Experiment& experiment, const ExperimentMesh& mesh, double noise) {
    if (experiment.noise_unit == NoiseUnit::box) return noise * mesh.extent;
    if (experiment.noise_unit == NoiseUnit::diagonal) return Vector3::Constant(noise * mesh.diagonal);
    if (experiment.noise_unit == NoiseUnit::edge) return Vector3::Constant(noise * mesh.mean_edge);
    const bool carried = noise_rule(experiment, mesh) == Carried::by_edge;
    return Vector3::Constant(carried ? noise / mesh.originals.front().mean_edge * mesh.mean_edge : noise);
}

UsableStep largest_usable_step(const SmoothingSubject& subject, int iterations) {
    SmoothingOptions options{.laplacian = subject.kind, .iterations = iterations, .area = subject.area, .blow_up_at = out_of_bounds};
    const auto usable = [&](double lambda) {
        options.lambda = lambda;
        return !smooth(subject.mesh(), options).blew_up;
    };
    // A stable step moves no vertex out of bounds; one far beyond the limit does, unless the flow has nothing to amplify.
    double low = subject.critical, high = 2 * low;
    while (usable(high) && high < 1e6 * subject.critical) high *= 2;
    while (high - low > 1e-3 * low) {
        const double middle = 0.5 * (low + high);
        (usable(middle) ? low : high) = middle;
    }
    return {0, subject.critical, low, iterations};
}

SmoothingExperiment smoothing_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    SmoothingExperiment result;
    result.meshes = experiment_meshes(library, experiment, settings);
    for_each_combination(
        experiment, result.meshes,
        [&](std::size_t m, const SmoothingSubject& subject, const SmoothingMethod& method, double given, ImplicitSolver& solver) {
            const double lambda = lambda_on(experiment, result.meshes[m], subject.kind, given, subject.critical);
            ExperimentRun run{m, method, subject.kind, subject.area, given, subject.critical, {}};
            run.run =
                run_smoothing(subject, method.scheme, lambda, experiment.iterations.back(), experiment.iterations, solver, method.rebuild);
            result.runs.push_back(std::move(run));
        });
    if (!experiment.search) return result;
    for (std::size_t m = 0; m < result.meshes.size(); ++m) {
        const SmoothingSubject subject = smoothing_subject(result.meshes[m].used, experiment.operators.front(), experiment.areas.front());
        result.usable.push_back(largest_usable_step(subject, experiment.iterations.back()));
        result.usable.back().mesh = m;
    }
    return result;
}

NoisyExperiment noisy_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    NoisyExperiment result;
    result.meshes = experiment_meshes(library, experiment, settings);
    for_each_combination(
        experiment, result.meshes,
        [&](std::size_t m, const SmoothingSubject& subject, const SmoothingMethod& method, double given, ImplicitSolver& solver) {
            for (std::size_t level = 0; level < experiment.noise.size(); ++level) {
                NoisyRun run{.mesh = m, .method = method, .kind = subject.kind, .area = subject.area, .given = given};
                run.lambda = lambda_on(experiment, result.meshes[m], subject.kind, given, subject.critical);
                run.noise = experiment.noise[level];
                run.minimum_said = experiment.minimum.empty() ? 0 : experiment.minimum[level];
                result.runs.push_back(noisy_run(result.meshes[m], experiment, std::move(run), solver));
            }
        });
    return result;
}

}   // namespace meshfolio::reproductions
