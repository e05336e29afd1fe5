#include "questions/q7_denoising/study.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_tasks.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/mesh_class.h"
#include "questions/core/value_lists.h"

namespace meshfolio::q7_denoising {

namespace {

/// σ over the box diagonal: from barely visible to hopeless.
const std::vector<double> default_noise{0.001, 0.003, 0.01, 0.03};

SmoothingOptions smoothing_by(const DenoisingGrid& grid, double lambda, int iterations) {
    return {.scheme = SmoothingScheme::implicit_euler, .lambda = lambda * grid.mean_edge * grid.mean_edge, .iterations = iterations};
}

/// A run is worth going on while some measure has been best in its second half, and for a dozen iterations at least.
class Patience {
public:
    bool go_on(const SearchState& state) {
        if (state.step == 1) best_.fill(infinity);
        for (std::size_t m = 0; m < measures.size(); ++m) {
            const double error = state.*measures[m].error;
            if (error < best_[m]) best_[m] = error, latest_ = state.step;
        }
        return state.step < std::max(12, 2 * latest_);
    }

private:
    std::array<double, measures.size()> best_{};
    int latest_ = 0;
};

double rms_where(const Vector& distances, const std::vector<char>& flags, char flag) {
    double sum = 0;
    int count = 0;
    for (Eigen::Index v = 0; v < distances.size(); ++v) {
        if (flags[static_cast<std::size_t>(v)] != flag) continue;
        sum += distances[v] * distances[v];
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

NoisyTrial trial_of(const DenoisingGrid& grid, const Positions& normals, double relative, std::uint64_t seed) {
    const TriangleMesh& clean = grid.clean->mesh();
    const MeshTopology& topology = grid.clean->prepared->topology;
    NoisyTrial trial;
    trial.relative = relative;
    trial.sigma = relative * grid.diagonal;
    trial.noisy = moved_to(clean, with_gaussian_noise(clean.X, Vector3::Constant(trial.sigma), seed));
    const SearchInput input{clean, normals, {trial.noisy, topology}, grid.mean_edge};
    Patience patience;
    trial.found = search(input, DenoisingMethod::implicit_flow, {grid.lambdas, grid.mean_edge * grid.mean_edge, grid.iterations},
                         [&](const SearchState& state, const Positions&) {
                             trial.states.push_back(state);
                             return patience.go_on(state);
                         });
    trial.best = moved_to(clean, trial.found.X);
    const SearchState& best = trial.found.by_shape;
    trial.over = best.step == 0 ? trial.noisy : moved_to(clean, smooth(trial.noisy, smoothing_by(grid, best.value, 4 * best.step)).X);
    const Vector distances = shape_distances(clean, topology.vertex_faces, trial.best.X);
    trial.on_features = rms_where(distances, grid.on_feature, 1);
    trial.elsewhere = rms_where(distances, grid.on_feature, 0);
    return trial;
}

}   // namespace

DenoisingGrid denoising_grid(std::shared_ptr<const LibraryMesh> source, const QuestionSettings& settings) {
    DenoisingGrid grid;
    grid.clean = std::move(source);
    const TriangleMesh& clean = grid.clean->mesh();
    const MeshTopology& topology = grid.clean->prepared->topology;
    grid.diagonal = bounding_box(clean).diagonal();
    grid.mean_edge = mean_edge_length(clean);
    for (const double lambda : each_once(settings.lambda)) grid.lambdas.push_back(lambda / (grid.mean_edge * grid.mean_edge));
    if (grid.lambdas.empty()) grid.lambdas = settings.quick ? std::vector{0.01, 0.1, 1.0} : std::vector{0.001, 0.01, 0.1, 1.0};
    grid.iterations = last_or(settings.iterations, settings.quick ? 16 : 48);
    grid.on_feature = feature_vertices(clean, topology);
    grid.feature_vertices = static_cast<int>(std::ranges::count(grid.on_feature, 1));

    SmoothingOptions options = smoothing_by(grid, grid.middle_lambda(), grid.iterations);
    grid.without_noise = {0};
    options.after_step = [&](int, const Positions& X) {
        grid.without_noise.push_back(shape_rms(clean, topology.vertex_faces, X));
        return true;
    };
    smooth(clean, options);

    std::vector<double> levels = settings.noise;
    if (levels.empty()) levels = settings.quick ? std::vector{0.003, 0.01} : default_noise;
    levels = each_once(levels);
    grid.trials.resize(levels.size());
    const Positions normals = face_normals(clean);
    for_each_task(levels.size(), [&](std::size_t i) { grid.trials[i] = trial_of(grid, normals, levels[i], settings.seed); });
    return grid;
}

std::string verdict_on(double gain) {
    if (std::isnan(gain)) return "–";
    return gain >= works ? "works" : gain >= helps ? "helps" : gain > 1 ? "fails" : "no gain";
}

NoiseSplit noise_split(const std::vector<DenoisingGrid>& grids, const Measure& measure) {
    NoiseSplit split;
    for (const DenoisingGrid& grid : grids) {
        for (const NoisyTrial& trial : grid.trials) {
            const double edges = trial.sigma / grid.mean_edge, gain = trial.gain(measure);
            if (gain >= helps)
                split.smallest_helped = std::min(split.smallest_helped, edges);
            else if (!std::isnan(gain))
                split.largest_failed = std::max(split.largest_failed, edges);
        }
    }
    return split;
}

}   // namespace meshfolio::q7_denoising
