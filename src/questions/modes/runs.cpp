#include "questions/modes/prediction_study.h"

#include <tuple>

#include "base/parallel_tasks.h"
#include "mesh/vertex_noise.h"

namespace meshfolio::modes {

namespace {

constexpr int chains = 4;   // tasks, each with solvers of its own; fixed, so that results do not depend on the machine

/// Interpolates between the ordered values. @param share  from 0 (smallest) to 1
double percentile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

/// Computes the mean and its standard error.
std::pair<Vector, Vector> mean_over(const std::vector<RunErrors>& runs, Vector RunErrors::*error) {
    const auto count = static_cast<double>(runs.size());
    Vector sum = Vector::Zero((runs.front().*error).size()), squares = sum;
    for (const RunErrors& run : runs) sum += run.*error;
    const Vector mean = sum / count;
    for (const RunErrors& run : runs) squares += (run.*error - mean).cwiseAbs2();
    return {mean, runs.size() > 1 ? Vector((squares / (count * (count - 1))).cwiseSqrt()) : Vector::Zero(mean.size())};
}

/// Smooths from Y and measures the errors; a run that collapsed is continued by its last positions.
/// @param probe  direction z of the risk estimate; empty: no estimate is made
SeedResult seed_result(const Work& work, FlowOperator kind, const Positions& Y, int iterations, const Positions& probe,
                       FlowSolvers& solvers) {
    SeedResult result;
    const auto whole_run = [&](const Positions& start) {
        Trajectory run = denoising_run(work.flow, kind, start, iterations, solvers);
        result.collapsed = static_cast<int>(run.size()) <= iterations;
        run.resize(iterations + 1, Positions(run.back()));
        return run;
    };
    const bool with_risk = probe.size() > 0;
    const Trajectory moved = with_risk ? whole_run(Y + work.difference * probe) : Trajectory(), run = whole_run(Y);
    result.errors = errors_of_run(work.flow, run);
    if (!with_risk) return result;
    result.risk = risk_estimate(run, moved, probe, work.difference);
    result.held_fixed.resize(iterations + 1);
    Positions Z = probe;
    for (int t = 0; t <= iterations; ++t) {
        if (t > 0) Z = solvers[int(kind)].step(Z);   // with the operator of Y, which the run has left in the solver
        result.held_fixed[t] = probe.cwiseProduct(Z).sum();
    }
    return result;
}

}   // namespace

DenoisingFlow::DenoisingFlow(TriangleMesh mesh, double step)
    : clean(std::move(mesh)), whole(operator_with_mass(laplace_beltrami(clean))), normals(vertex_normals(clean)), lambda(step) {}

Trajectory denoising_run(const DenoisingFlow& flow, FlowOperator kind, const Positions& Y, int iterations, FlowSolvers& solvers) {
    Trajectory run{Y};
    run.reserve(iterations + 1);
    ImplicitSolver& solver = solvers[int(kind)];
    try {
        solver.prepare(kind == FlowOperator::clean ? flow.whole : operator_with_mass(laplace_beltrami(moved_to(flow.clean, Y))),
                       flow.lambda);
        for (int t = 0; t < iterations; ++t) run.push_back(solver.step(run.back()));
    } catch (const SolverError&) {   // triangles are so thin that rounding makes −C indefinite
    }
    return run;
}

RunErrors errors_of_run(const DenoisingFlow& flow, const Trajectory& run) {
    const auto length = static_cast<Eigen::Index>(run.size());
    RunErrors errors{Vector(length), Vector(length), Vector(length)};
    const auto vertices = static_cast<double>(flow.clean.X.rows());
    for (Eigen::Index t = 0; t < length; ++t) {
        const Positions off = run[t] - flow.clean.X;
        const Vector squares = off.rowwise().squaredNorm();
        errors.vertices[t] = squares.sum() / vertices;
        errors.mass[t] = flow.whole.M.dot(squares(flow.whole.vertex)) / flow.whole.M.sum();
        errors.tangential[t] = errors.vertices[t] - off.cwiseProduct(flow.normals).rowwise().sum().squaredNorm() / vertices;
    }
    return errors;
}

MeasuredCurve measured_curve(const std::vector<RunErrors>& runs) {
    if (runs.empty()) throw MeshError("measured_curve() has no runs to average", "give it one run at least");
    MeasuredCurve curve;
    std::tie(curve.square, curve.square_error) = mean_over(runs, &RunErrors::vertices);
    std::tie(curve.mass, curve.mass_error) = mean_over(runs, &RunErrors::mass);
    curve.tangential = mean_over(runs, &RunErrors::tangential).first;
    curve.low = curve.high = Vector(curve.square.size());
    curve.seeds = static_cast<int>(runs.size());
    for (Eigen::Index t = 0; t < curve.square.size(); ++t) {
        const std::vector<double> rms = each_of(runs, [&](const RunErrors& run) { return std::sqrt(run.vertices[t]); });
        curve.low[t] = percentile(rms, 0.1);
        curve.high[t] = percentile(rms, 0.9);
    }
    return curve;
}

Extent extent_of(const QuestionSettings& settings, int vertices) {
    Extent extent;
    extent.levels = settings.noise;
    if (extent.levels.empty() && settings.laboratory) extent.levels = {0.001, 0.003, 0.01, 0.03};
    if (extent.levels.empty()) extent.levels = settings.quick ? std::vector{0.01} : std::vector{0.003, 0.01};
    extent.levels = each_once(extent.levels);
    const int most = last_or(settings.iterations, settings.laboratory ? 80 : settings.quick ? 10 : 40);
    extent.iterations = std::clamp(600'000 / vertices, std::min(8, most), most);
    extent.rule_seeds = settings.quick ? 4 : vertices > 3000 ? 8 : 20;
    if (settings.quick) extent.modes_up_to = 300;   // for more, all modes take longer than all the rest
    return extent;
}

std::uint64_t seed_of(const QuestionSettings& settings, std::size_t level, int run) {
    return settings.seed + 1000 * (level + 1) + static_cast<std::uint64_t>(run);
}

TriangleMesh Work::noisy(double sigma, std::size_t level, int run) const {
    return moved_to(flow.clean, with_gaussian_noise(flow.clean.X, Vector3::Constant(sigma), seed_of(settings, level, run)));
}

std::vector<LevelResults> results_of_levels(const Work& work, const std::vector<int>& iterations) {
    const Extent& extent = work.extent;
    std::vector<LevelResults> levels(iterations.size());
    for (LevelResults& level : levels) {
        for (auto& results : level.of) results.resize(extent.seeds);
        level.estimates.resize(extent.rule_seeds);
    }
    for_each_task(chains, [&](std::size_t chain) {
        FlowSolvers solvers;
        for (std::size_t l = 0; l < levels.size(); ++l) {
            for (int seed = static_cast<int>(chain); seed < extent.seeds; seed += chains) {
                const TriangleMesh noisy = work.noisy(extent.levels[l], l, seed);
                Positions probe;
                if (seed < extent.rule_seeds) {
                    levels[l].estimates[seed] = noise_level(noisy, work.topology);
                    probe = random_signs(noisy.X.rows(), seed_of(work.settings, l, first_probe + seed));
                }
                auto& [with_clean, with_own] = levels[l].of;
                with_clean[seed] = seed_result(work, FlowOperator::clean, noisy.X, iterations[l], {}, solvers);
                with_own[seed] = seed_result(work, FlowOperator::noisy, noisy.X, iterations[l], probe, solvers);
            }
        }
    });
    return levels;
}

}   // namespace meshfolio::modes
