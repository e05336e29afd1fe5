#include <Eigen/Geometry>
#include <set>

#include "mesh/vertex_noise.h"
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

namespace {

ExperimentMesh experiment_mesh(const OriginalMesh& original, SharedMesh used, const Experiment& experiment) {
    ExperimentMesh mesh{{original}, std::move(used)};
    mesh.name = mesh.used->name;
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

/// Calls `visit` with every variant, its λ on the mesh, its subject, and a solver for all λ of an operator.
template <class Visit> void for_each_variant(const Experiment& experiment, const std::vector<ExperimentMesh>& meshes, Visit visit) {
    for (const ExperimentMesh& mesh : meshes)
        for (const OperatorKind kind : experiment.operators)
            for (const AreaForm area : experiment.areas) {
                const SmoothingSubject subject = smoothing_subject(mesh.used, kind, area);
                ImplicitSolver solver;   // one symbolic analysis for all λ
                for (const SmoothingMethod& method : experiment.methods)
                    for (const double given : experiment.lambda)
                        visit(Variant{&mesh, kind, area, method, given}, lambda_on(experiment, mesh, kind, given, subject.critical),
                              subject, solver);
            }
}

/// Smooths the noisy mesh and measures it after each iteration.
void run_noisy(const Experiment& experiment, NoisyRun& run, ImplicitSolver& solver) {
    const TriangleMesh& clean = run.mesh->mesh();
    const TriangleMesh noisy = moved_to(clean, with_gaussian_noise(clean.X, run.sigma, experiment.seed));
    run.rms = {vertex_rms(clean.X, noisy.X)};
    run.noisy_X = run.best_X = noisy.X;
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
        if (std::ranges::binary_search(experiment.iterations, iteration)) run.snapshots.push_back(X);
        return true;
    };
    const Smoothed result = smooth_until_collapse(noisy, options, solver);
    run.blew_up = result.blew_up;
    run.collapse_iteration = result.collapse_iteration;
    run.blow_up_iteration = result.blow_up_iteration;
    const Positions normals = face_normals(clean);
    run.noisy_angle = mean_normal_angle(normals, face_normals(noisy));
    run.last_angle = mean_normal_angle(normals, face_normals(moved_to(clean, result.X)));
}

}   // namespace

std::vector<ExperimentMesh> experiment_meshes(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings) {
    std::vector<ExperimentMesh> meshes;
    if (experiment.meshes.empty()) return meshes;
    if (library.has_own_meshes()) {
        for (const auto& own : library.own_meshes()) meshes.push_back(experiment_mesh(experiment.meshes.front(), own, experiment));
        return meshes;
    }
    for (const OriginalMesh& original : experiment.meshes) {
        const auto used = library.original(original.name, original.file, original.stand_in, settings.base);
        const auto same = std::ranges::find_if(meshes, [&](const ExperimentMesh& mesh) {
            return mesh.stand_in && used->input.stand_in && mesh.used->input.file == used->input.file;
        });
        if (same != meshes.end()) same->originals.push_back(original);
        else meshes.push_back(experiment_mesh(original, used, experiment));
    }
    std::set<std::string> taken;   // files of one name from several places, or a mesh and another's stand-in, get numbers
    for (ExperimentMesh& mesh : meshes)
        for (int number = 2; !taken.insert(mesh.name).second; ++number) mesh.name = mesh.used->name + "_" + std::to_string(number);
    return meshes;
}

Carried lambda_rule(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind) {
    if (!mesh.stand_in || experiment.lambda_unit != StepUnit::raw || is_dimensionless(kind)) return Carried::as_given;
    const OriginalMesh& original = mesh.originals.front();
    if (is_noisy(experiment)) return original.mean_edge > 0 ? Carried::by_edge : Carried::as_given;
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

double largest_usable_step(const SmoothingSubject& subject, int iterations) {
    SmoothingOptions options{.laplacian = subject.kind, .iterations = iterations, .area = subject.area, .blow_up_at = 3};
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
    return low;
}

SmoothingExperiment smoothing_experiment(const MeshLibrary& library, const Experiment& e, const QuestionSettings& settings) {
    SmoothingExperiment done;
    done.meshes = experiment_meshes(library, e, settings);
    for_each_variant(e, done.meshes, [&](const Variant& v, double lambda, const SmoothingSubject& subject, ImplicitSolver& solver) {
        const int last = e.iterations.back();
        done.results.push_back(
            {v, subject.critical, run_smoothing(subject, v.method.scheme, lambda, last, e.iterations, solver, v.method.rebuild)});
    });
    for (std::size_t m = 0; e.search && m < done.meshes.size(); ++m) {
        const SmoothingSubject subject = smoothing_subject(done.meshes[m].used, e.operators.front(), e.areas.front());
        done.usable.push_back({&done.meshes[m], largest_usable_step(subject, e.iterations.back()), subject.critical});
    }
    return done;
}

Done<NoisyRun> noisy_experiment(const MeshLibrary& library, const Experiment& e, const QuestionSettings& settings) {
    Done<NoisyRun> done;
    done.meshes = experiment_meshes(library, e, settings);
    for_each_variant(e, done.meshes, [&](const Variant& v, double lambda, const SmoothingSubject&, ImplicitSolver& solver) {
        for (std::size_t level = 0; level < e.noise.size(); ++level) {
            NoisyRun& run = done.results.emplace_back(NoisyRun{v, lambda, e.noise[level], noise_on(e, *v.mesh, e.noise[level])});
            run.minimum_said = e.minimum.empty() ? 0 : e.minimum[level];
            run_noisy(e, run, solver);
        }
    });
    return done;
}

}   // namespace meshfolio::reproductions
