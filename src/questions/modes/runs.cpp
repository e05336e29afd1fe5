#include "questions/modes/prediction_study.h"

#include <tuple>

namespace meshfolio::modes {

namespace {

/// Between the values around that share of their order.
double percentile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

/// The mean, and its standard error.
std::pair<Vector, Vector> mean_over(const std::vector<RunErrors>& runs, Vector RunErrors::*error) {
    const auto count = static_cast<double>(runs.size());
    Vector sum = Vector::Zero((runs.front().*error).size()), squares = sum;
    for (const RunErrors& run : runs) sum += run.*error;
    const Vector mean = sum / count;
    for (const RunErrors& run : runs) squares += (run.*error - mean).cwiseAbs2();
    return {mean, runs.size() > 1 ? Vector((squares / (count * (count - 1))).cwiseSqrt()) : Vector::Zero(mean.size())};
}

}   // namespace

DenoisingFlow::DenoisingFlow(TriangleMesh mesh, double step)
    : clean(std::move(mesh)), whole(operator_with_mass(laplace_beltrami(clean))), normals(vertex_normals(clean)), lambda(step) {}

Trajectory denoising_run(const DenoisingFlow& flow, FlowOperator kind, const Positions& Y, int iterations, FlowSolvers& solvers) {
    Trajectory run{Y};
    run.reserve(iterations + 1);
    const bool clean = kind == FlowOperator::clean;
    ImplicitSolver& solver = clean ? solvers.clean : solvers.own;
    try {
        solver.prepare(clean ? flow.whole : operator_with_mass(laplace_beltrami(moved_to(flow.clean, Y))), flow.lambda);
        for (int t = 0; t < iterations; ++t) run.push_back(solver.step(run.back()));
    } catch (const SolverError&) {   // triangles so thin that rounding makes −C indefinite: what was reached stands
    }
    return run;
}

Trajectory kept_at_its_end(Trajectory run, int iterations) {
    run.resize(iterations + 1, Positions(run.back()));
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
        errors.along[t] = errors.vertices[t] - off.cwiseProduct(flow.normals).rowwise().sum().squaredNorm() / vertices;
    }
    return errors;
}

int MeasuredCurve::best() const { return first_smallest(square); }

MeasuredCurve measured_curve(const std::vector<RunErrors>& runs) {
    if (runs.empty()) throw MeshError("measured_curve: no runs");
    MeasuredCurve curve;
    std::tie(curve.square, curve.square_error) = mean_over(runs, &RunErrors::vertices);
    std::tie(curve.mass, curve.mass_error) = mean_over(runs, &RunErrors::mass);
    curve.along = mean_over(runs, &RunErrors::along).first;
    curve.low = curve.high = Vector(curve.square.size());
    curve.seeds = static_cast<int>(runs.size());
    for (Eigen::Index t = 0; t < curve.square.size(); ++t) {
        const std::vector<double> rms = each_of(runs, [&](const RunErrors& run) { return std::sqrt(run.vertices[t]); });
        curve.low[t] = percentile(rms, 0.1);
        curve.high[t] = percentile(rms, 0.9);
    }
    return curve;
}

int first_smallest(const Vector& values) {
    Eigen::Index first = 0;
    values.minCoeff(&first);
    return static_cast<int>(first);
}

}   // namespace meshfolio::modes
