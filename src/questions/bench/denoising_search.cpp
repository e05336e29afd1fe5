#include "questions/bench/denoising_search.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// Returns `count` values from `low` to `high` in a geometric sequence; for a count of 1 their geometric mean.
std::vector<double> geometric(double low, double high, int count) {
    if (count == 1) return {std::sqrt(low * high)};
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
    return values;
}

/// Runs the method with the parameter value × plan.unit and enters each state with a smaller error than before into `result`.
void run_with(const SearchInput& input, double value, const SearchPlan& plan,
              const std::function<bool(const SearchState&, const Positions&)>& after_state, ImplicitSolver& solver, SearchResult& result) {
    DenoisingOptions options;
    options.method = result.method;
    options.parameter = value * plan.unit;
    options.steps = plan.steps;
    TriangleMesh smoothed = input.clean;
    const Vector3 centre = bounding_box(input.clean).centre();
    options.after_step = [&](int step, const Positions& X) {
        smoothed.X = X;
        const SearchState state{.value = value,
                                .step = step,
                                .shape = shape_rms(input.clean, X),
                                .rms = vertex_rms(input.clean.X, X),
                                .angle = mean_normal_angle(input.clean_normals, face_normals(smoothed)),
                                .volume = signed_volume(smoothed, centre)};
        ++result.steps;
        if (state.shape < result.by_shape.shape) {
            result.by_shape = state;
            result.X = X;
        }
        if (state.rms < result.by_rms.rms) result.by_rms = state;
        if (state.angle < result.by_angle.angle) result.by_angle = state;
        return !after_state || after_state(state, X);
    };
    try {
        result.failed += denoise(input.noisy, options, solver).ended ? 1 : 0;
    } catch (const SolverError&) {
        ++result.failed;
    }
}

}   // namespace

double SearchResult::gain() const { return defined && noisy.shape > 1e-9 * noisy.rms ? noisy.shape / by_shape.shape : undefined; }

double SearchResult::rms_gain() const { return defined ? noisy.rms / by_rms.rms : undefined; }

double SearchResult::angle_gain() const { return defined && noisy.angle > 1e-6 ? noisy.angle / by_angle.angle : undefined; }

SearchPlan search_plan(DenoisingMethod method, const SearchBudget& budget, double mean_edge, double largest_eigenvalue) {
    SearchPlan plan;
    const bool has_stability_limit = method == DenoisingMethod::explicit_flow || method == DenoisingMethod::taubin;
    const int values = has_stability_limit ? std::max(1, budget.values / 2) : budget.values;
    plan.steps = budget.total() / values;
    if (method == DenoisingMethod::explicit_flow) {
        plan.values = geometric(0.05, 0.9, values);
        plan.unit = 2 / largest_eigenvalue;
    } else if (method == DenoisingMethod::taubin) {
        plan.values = geometric(0.01, 0.3, values);
    } else if (filters_normals(method)) {
        plan.values = geometric(0.1, 1, values);
    } else {
        plan.values = geometric(0.0025, 2.56, values);
        plan.unit = mean_edge * mean_edge;
    }
    return plan;
}

SearchResult search(const SearchInput& input, DenoisingMethod method, const SearchBudget& budget) {
    return search(input, method, search_plan(method, budget, input.mean_edge, input.noisy.largest_eigenvalue));
}

SearchResult search(const SearchInput& input, DenoisingMethod method, const SearchPlan& plan,
                    const std::function<bool(const SearchState&, const Positions&)>& after_state) {
    SearchResult result;
    result.method = method;
    result.X = input.noisy.mesh.X;
    result.noisy.shape = shape_rms(input.clean, result.X);
    result.noisy.rms = vertex_rms(input.clean.X, result.X);
    result.noisy.angle = mean_normal_angle(input.clean_normals, face_normals(input.noisy.mesh));
    result.noisy.volume = signed_volume(input.noisy.mesh);
    result.by_shape = result.by_rms = result.by_angle = result.noisy;
    result.defined = is_defined(method, input.noisy.mesh, input.noisy.topology);
    if (result.defined) {
        ImplicitSolver solver;   // the triangles stay: one symbolic analysis for all runs, one factorisation per λ if L is frozen
        for (const double value : plan.values) run_with(input, value, plan, after_state, solver, result);
    }
    result.difference = compare_meshes(input.clean, moved_to(input.clean, result.X));
    return result;
}

}   // namespace meshfolio
