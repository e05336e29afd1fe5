#include "questions/bench/denoising_study.h"

#include <algorithm>
#include <cmath>

#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/mesh_class.h"
#include "questions/core/value_lists.h"

namespace meshfolio {

namespace {

/// σ over the box diagonal: from barely visible to hopeless.
const std::vector<double> default_noise{0.001, 0.003, 0.01, 0.03};
/// Step of the implicit scheme in squared mean edges: small enough that the minimum of the error lies at several iterations.
constexpr double step_in_squared_edges = 0.1;

/// rms over the vertices whose flag is `flag`. [length]
double rms_where(const DenoisingStudy& study, const Positions& X, char flag) {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < X.rows(); ++v) {
        if (study.on_feature[static_cast<std::size_t>(v)] != flag) continue;
        sum += (X.row(v) - study.clean->mesh().X.row(v)).squaredNorm();
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

SmoothingOptions denoiser(const DenoisingStudy& study) {
    return {.scheme = SmoothingScheme::implicit_euler, .lambda = study.lambda, .iterations = study.most_iterations};
}

DenoisingTrial trial_of(const DenoisingStudy& study, double relative, std::uint64_t seed, ImplicitSolver& solver) {
    const TriangleMesh& clean = study.clean->mesh();
    const Positions normals = face_normals(clean);
    DenoisingTrial trial;
    trial.relative = relative;
    trial.sigma = relative * study.diagonal;
    trial.noisy = moved_to(clean, with_gaussian_noise(clean.X, Vector3::Constant(trial.sigma), seed));
    trial.best = trial.noisy;
    trial.rms = {vertex_rms(clean.X, trial.noisy.X)};
    trial.angle = {mean_normal_angle(normals, face_normals(trial.noisy))};

    SmoothingOptions options = denoiser(study);
    options.after_step = [&](int iteration, const Positions& X) {
        trial.rms.push_back(vertex_rms(clean.X, X));
        trial.angle.push_back(mean_normal_angle(normals, face_normals(moved_to(clean, X))));
        if (trial.rms.back() < trial.least_rms()) {
            trial.best_rms = iteration;
            trial.best.X = X;
        }
        if (trial.angle.back() < trial.least_angle()) trial.best_angle = iteration;
        return iteration < std::max(study.iterations, 2 * trial.best_rms);
    };
    trial.last = moved_to(clean, smooth(trial.noisy, options, solver).X);
    trial.feature_rms = rms_where(study, trial.best.X, 1);
    trial.smooth_rms = rms_where(study, trial.best.X, 0);
    return trial;
}

}   // namespace

DenoisingStudy denoising_study(std::shared_ptr<const LibraryMesh> clean, const QuestionSettings& settings) {
    DenoisingStudy study;
    study.clean = std::move(clean);
    study.diagonal = bounding_box(study.clean->mesh()).diagonal();
    study.mean_edge = mean_edge_length(study.clean->mesh());
    study.lambda = settings.lambda.empty() ? step_in_squared_edges * study.mean_edge * study.mean_edge : settings.lambda.front();
    study.iterations = last_or(settings.iterations, settings.quick ? 20 : 40);
    study.most_iterations = settings.iterations.empty() ? 15 * study.iterations : study.iterations;
    study.on_feature = feature_vertices(study.clean->mesh(), study.clean->prepared->topology);
    study.feature_vertices = static_cast<int>(std::ranges::count(study.on_feature, 1));

    study.without_noise = {0};
    SmoothingOptions options = denoiser(study);
    options.iterations = study.iterations;
    options.after_step = [&](int, const Positions& X) {
        study.without_noise.push_back(vertex_rms(study.clean->mesh().X, X));
        return true;
    };
    ImplicitSolver solver;   // noise moves the vertices, but their triangles are the same: one symbolic analysis for all levels
    smooth(study.clean->mesh(), options, solver);

    std::vector<double> levels = settings.noise;
    if (levels.empty()) levels = settings.quick ? std::vector{0.003, 0.01} : default_noise;
    for (const double level : each_once(levels)) study.trials.push_back(trial_of(study, level, settings.seed, solver));
    study.analyses = solver.analyses();
    return study;
}

}   // namespace meshfolio
