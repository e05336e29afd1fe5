#include "questions/q7_denoising/study.h"

#include "base/parallel_tasks.h"
#include "geometry/curvature/curvature.h"
#include "geometry/denoising/denoising_prediction.h"
#include "geometry/denoising/noise_level.h"
#include "geometry/denoising/risk_estimate.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/mesh_class.h"

namespace meshfolio::q7_denoising {

namespace {

/// Further samples of noise of equal strength.
constexpr int further_seeds = 2;

/// Returns the options of one implicit run. @param lambda  [h̄²]
SmoothingOptions smoothing_by(const DenoisingGrid& grid, double lambda, int iterations) {
    return {.scheme = SmoothingScheme::implicit_euler, .lambda = lambda * grid.mean_edge * grid.mean_edge, .iterations = iterations};
}

/// Flags the most curved tenth of the vertices; none of a flat mesh.
std::vector<char> most_curved(const TriangleMesh& mesh, const MeshTopology& topology) {
    const Vector H = cotangent_mean_curvature(mesh, topology, laplace_beltrami(mesh));
    std::vector<std::pair<double, Eigen::Index>> order;
    for (Eigen::Index v = 0; v < H.size(); ++v)
        if (std::isfinite(H[v])) order.push_back({-std::abs(H[v]), v});
    std::ranges::sort(order);
    std::vector<char> flags(H.size(), 0);
    if (order.empty() || -order.front().first * bounding_box(mesh).diagonal() < 1e-6) return flags;
    for (std::size_t i = 0; i < order.size() / 10; ++i) flags[order[i].second] = 1;
    return flags;
}

/// Splits n distances by n flags.
SplitRms rms_by(const Vector& distances, const std::vector<char>& flags) {
    const FlaggedMeans squares = flagged_means(distances.cwiseAbs2(), flags);
    return {std::sqrt(squares.there), std::sqrt(squares.elsewhere)};
}

/// Computes the errors of a smoothed mesh against grid.clean. @param normals  of the faces of the clean mesh
SurfaceErrors errors_of(const DenoisingGrid& grid, const Positions& normals, const TriangleMesh& smoothed) {
    const TriangleMesh& clean = grid.clean->mesh();
    SurfaceErrors errors;
    const Vector distances = shape_distances(clean, smoothed.X);
    errors.features = rms_by(distances, grid.on_feature);
    errors.curved = rms_by(distances, grid.curved);

    const Positions found = face_normals(smoothed);
    std::vector<int> at_features, others;
    for (int f = 0; f < clean.face_count(); ++f) {
        const bool at_feature = std::ranges::any_of(clean.F.row(f), [&](int v) { return grid.on_feature[v] != 0; });
        (at_feature ? at_features : others).push_back(f);
    }
    const auto angle_of = [&](const std::vector<int>& faces) {
        return faces.empty() ? NAN : mean_normal_angle(normals(faces, Eigen::all), found(faces, Eigen::all));
    };
    errors.feature_angle = angle_of(at_features);
    errors.other_angle = angle_of(others);
    if (grid.clean->preflight().encloses_volume()) errors.volume = signed_volume(smoothed) / signed_volume(clean);
    return errors;
}

/// A run from Y. Its difference along z from a run from Y + εz is the divergence in Stein's estimate.
struct WatchedRun {
    Positions z;                             // n × 3, random signs
    std::vector<double> residual, along_z;   // |X − Y|², z · (X − Y), after t = 0, 1, … iterations
    std::vector<double> shape;               // rms distance to the clean surface

    void enter(const Positions& moved, double distance) {
        residual.push_back(moved.squaredNorm());
        along_z.push_back(z.cwiseProduct(moved).sum());
        shape.push_back(distance);
    }
};

/// Stops a run by Stein's estimate. @param run  at the step in the middle of the grid
Stopped stopped_without_clean(const DenoisingGrid& grid, const NoisyTrial& trial, const WatchedRun& run, ImplicitSolver& solver) {
    const TriangleMesh& noisy = trial.noisy;
    const double sigma = noise_level(noisy, grid.clean->topology()).sigma, amount = 1e-4 * grid.mean_edge;
    if (!(sigma > 0) || !(trial.found.noisy.shape > 0)) return {};
    std::vector<double> divergence{3.0 * noisy.vertex_count()};
    SmoothingOptions options = smoothing_by(grid, grid.middle_lambda(), static_cast<int>(run.along_z.size()) - 1);
    options.after_step = [&](int t, const Positions& X) {
        divergence.push_back((run.z.cwiseProduct(X - noisy.X).sum() - run.along_z[t]) / amount);
        return true;
    };
    smooth(moved_to(noisy, noisy.X + amount * run.z), options, solver);
    const auto vector = [&](const std::vector<double>& values) {
        return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(divergence.size()));
    };
    const int best = RiskEstimate{vector(run.residual), vector(divergence), divergence[0]}.best(sigma);
    return {best, run.shape[0] / run.shape[best], run.shape[0] / std::ranges::min(run.shape)};
}

/// Makes the noise of one level, and searches the best states. @param further  number of further seeds
NoisyTrial trial_of(const DenoisingGrid& grid, const Positions& normals, double relative, std::uint64_t seed, int further) {
    const TriangleMesh& clean = grid.clean->mesh();
    const MeshTopology& topology = grid.clean->topology();
    NoisyTrial trial;
    trial.relative = relative;
    trial.sigma = relative * grid.diagonal;
    if (grid.clean->preflight().encloses_volume()) trial.clean_volume = signed_volume(clean);
    trial.noisy = moved_to(clean, with_gaussian_noise(clean.X, Vector3::Constant(trial.sigma), seed));
    const SearchInput input{clean, normals, {trial.noisy, topology}, grid.mean_edge};
    WatchedRun middle{random_signs(clean.X.rows(), seed), {}, {}, {}};
    middle.enter(Positions::Zero(clean.X.rows(), 3), shape_rms(clean, trial.noisy.X));
    trial.found = search_for_best(input, grid.lambdas, grid.iterations, [&](const SearchState& state, const Positions& X) {
        trial.states.push_back(state);
        if (state.value == grid.middle_lambda()) middle.enter(X - trial.noisy.X, state.shape);
    });
    trial.best = moved_to(clean, trial.found.X);
    ImplicitSolver solver;   // the triangles stay: one symbolic analysis for all
    trial.residual = errors_of(grid, normals, trial.best);
    trial.stopped = stopped_without_clean(grid, trial, middle, solver);
    const SmoothingOptions best = smoothing_by(grid, trial.found.by_shape.value, trial.found.by_shape.step);
    for (int i = 1; trial.improved() && i <= further; ++i) {
        const auto other_seed = seed + static_cast<std::uint64_t>(i);
        const TriangleMesh noisy = moved_to(clean, with_gaussian_noise(clean.X, Vector3::Constant(trial.sigma), other_seed));
        trial.further_gains.push_back(shape_rms(clean, noisy.X) / shape_rms(clean, smooth(noisy, best, solver).X));
    }
    return trial;
}

/// Fills `over`, `clean_alike` and `clean_loss` of pictured().
void smooth_pictured(DenoisingGrid& grid, const Positions& normals) {
    const TriangleMesh& clean = grid.clean->mesh();
    NoisyTrial& trial = *std::ranges::find(grid.trials, &grid.pictured(), [](const NoisyTrial& t) { return &t; });
    const SearchState& best = trial.found.by_shape;
    const auto smoothed = [&](const TriangleMesh& mesh, int steps) {
        return steps == 0 ? mesh : moved_to(clean, smooth(mesh, smoothing_by(grid, best.value, steps)).X);
    };
    trial.over = smoothed(trial.noisy, 4 * best.step);
    trial.clean_alike = smoothed(clean, best.step);
    trial.clean_loss = errors_of(grid, normals, trial.clean_alike);
}

/// Runs on noise of a kind, as strong as that of pictured(), at its λ and for up to twice its iterations.
OtherNoise other_noise_of(const DenoisingGrid& grid, NoiseKind kind, std::uint64_t seed) {
    const TriangleMesh& clean = grid.clean->mesh();
    const NoisyTrial& trial = grid.pictured();
    const SearchState& chosen = trial.found.by_shape;
    const TriangleMesh noisy = moved_to(clean, with_noise(clean, kind, trial.sigma, seed));
    std::vector<char> hit(clean.vertex_count());
    for (int v = 0; v < clean.vertex_count(); ++v) hit[v] = noisy.X.row(v) != clean.X.row(v);

    const double before = shape_rms(clean, noisy.X);
    OtherNoise other{.kind = kind, .best = 1};
    SmoothingOptions options = smoothing_by(grid, chosen.value, std::min(grid.iterations, 2 * chosen.step));
    options.after_step = [&](int t, const Positions& X) {
        const Vector distances = shape_distances(clean, X);
        const double gain = before / std::sqrt(distances.squaredNorm() / static_cast<double>(distances.size()));
        other.best = std::max(other.best, gain);
        if (t == chosen.step) {
            const SplitRms left = rms_by(distances, hit);
            other.same = gain;
            other.spread = left.elsewhere / left.there;
        }
        return true;
    };
    smooth(noisy, options);
    return other;
}

}   // namespace

DenoisingTries tries_of(const QuestionSettings& settings, double mean_edge) {
    DenoisingTries tries;
    tries.noise = settings.noise;
    if (tries.noise.empty()) tries.noise = settings.quick ? std::vector{0.003, 0.01} : std::vector{0.001, 0.003, 0.01, 0.03};
    tries.noise = each_once(tries.noise);
    for (const double lambda : each_once(settings.lambda)) tries.lambdas.push_back(lambda / (mean_edge * mean_edge));
    if (tries.lambdas.empty()) tries.lambdas = settings.quick ? std::vector{0.01, 0.1, 1.0} : std::vector{0.003, 0.03, 0.3, 3.0};
    tries.iterations = last_or(settings.iterations, settings.quick ? 16 : 32);
    return tries;
}

SearchResult search_for_best(const SearchInput& input, const std::vector<double>& lambdas, int iterations,
                             const std::function<void(const SearchState&, const Positions&)>& met) {
    std::array<double, measures.size()> best{};   // of the run
    int latest = 0;                               // iteration at which a measure was best
    const auto worth_going_on = [&](const SearchState& state, const Positions& X) {
        if (met) met(state, X);
        if (state.step == 1) best.fill(infinity);
        for (std::size_t m = 0; m < measures.size(); ++m)
            if (const double error = state.*measures[m].error; error < best[m]) best[m] = error, latest = state.step;
        return state.step < std::max(12, 2 * latest);
    };
    return search(input, DenoisingMethod::implicit_flow, {lambdas, input.mean_edge * input.mean_edge, iterations}, worth_going_on);
}

DenoisingGrid denoising_grid(SharedMesh source, const QuestionSettings& settings) {
    DenoisingGrid grid;
    grid.clean = std::move(source);
    const TriangleMesh& clean = grid.clean->mesh();
    const MeshTopology& topology = grid.clean->topology();
    grid.diagonal = bounding_box(clean).diagonal();
    grid.mean_edge = mean_edge_length(clean);
    DenoisingTries tries = tries_of(settings, grid.mean_edge);
    grid.lambdas = tries.lambdas;
    grid.iterations = tries.iterations;
    grid.fitted_to_clean = noise_level(clean, topology).sigma / grid.mean_edge;
    grid.on_feature = feature_vertices(clean, topology);
    grid.curved = most_curved(clean, topology);
    grid.feature_vertices = static_cast<int>(std::ranges::count(grid.on_feature, 1));

    if (tries_in_edges(settings)) tries.noise.push_back(level_in_edges * grid.mean_edge / grid.diagonal);
    tries.noise = each_once(tries.noise);
    grid.trials.resize(tries.noise.size());
    const Positions normals = face_normals(clean);
    for_each_task(tries.noise.size(), [&](std::size_t i) {
        grid.trials[i] = trial_of(grid, normals, tries.noise[i], settings.seed, settings.quick ? 0 : further_seeds);
    });
    smooth_pictured(grid, normals);
    if (!grid.pictured().improved()) return grid;
    grid.other_noise.resize(2);
    for_each_task(2, [&](std::size_t i) {
        grid.other_noise[i] = other_noise_of(grid, i == 0 ? NoiseKind::normal : NoiseKind::impulsive, settings.seed);
    });
    return grid;
}

std::shared_ptr<const Grids> denoising_grids(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                             report::Section& section) {
    return std::make_shared<const Grids>(studies_of(meshes, "denoising", settings, progress, section, denoising_grid));
}

const NoisyTrial& DenoisingGrid::pictured() const {
    const auto gain = [](const NoisyTrial& trial) { return trial.improved() ? trial.gain() : 0; };
    const auto halved = std::ranges::find_if(trials, [&](const NoisyTrial& trial) { return gain(trial) >= works; });
    return halved != trials.end() ? *halved : *std::ranges::max_element(trials, {}, gain);
}

double NoisyTrial::spread() const {
    if (further_gains.empty()) return NAN;
    std::vector<double> gains = further_gains;
    gains.push_back(gain());
    const Eigen::Map<const Vector> all(gains.data(), static_cast<Eigen::Index>(gains.size()));
    return std::sqrt((all.array() - all.mean()).square().sum() / static_cast<double>(further_gains.size()));
}

double NoisyTrial::removed_along() const { return 1 - std::pow(drift(found.by_shape) / drift(found.noisy), 2); }

std::string verdict_on(const NoisyTrial& trial) {
    const double gain = trial.gain();
    if (std::isnan(gain)) return "–";
    if (gain < helps) return "fails";
    if (trial.volume_by(measures[0]) < volume_to_keep) return "shrinks";
    return gain >= works ? "works" : "helps";
}

bool lies_at_an_end(const NoisyTrial& trial, const SearchState& best) {
    const auto amount = [](const SearchState& s) { return s.value * s.step; };
    const auto [least, most] = std::ranges::minmax_element(trial.states, {}, amount);
    return best.step > 0 && (amount(best) <= amount(*least) || amount(best) >= amount(*most));
}

NoiseSplit noise_split(const Grids& grids) {
    constexpr double equal = 1 + 1e-9;
    std::vector<double> halved, other;
    for (const DenoisingGrid& grid : grids)
        for (const NoisyTrial& trial : grid.trials)
            if (const double gain = trial.gain(); !std::isnan(gain)) (gain >= works ? halved : other).push_back(grid.edges(trial));
    const double lowest = halved.empty() ? INFINITY : std::ranges::min(halved), highest = other.empty() ? 0 : std::ranges::max(other);
    NoiseSplit split;
    for (const double level : other)
        if (level * equal < lowest) split.never_to = std::max(split.never_to, level);
    for (const double level : halved)
        if (level > highest * equal) split.always_from = std::min(split.always_from, level);
    split.decides = highest * equal < lowest;
    return split;
}

}   // namespace meshfolio::q7_denoising
