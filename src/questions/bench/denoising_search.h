/// @file
/// The best result of a denoising method on one noisy mesh, chosen with the clean one: question 7 searches a grid of implicit steps, the
/// denoising laboratory every method within the same number of steps.
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "geometry/denoising/denoising_methods.h"
#include "geometry/measures/mesh_error.h"

namespace meshfolio {

/// The number of runs and their length. Methods with a stability limit take half as many values and twice as many steps.
struct SearchBudget {
    int values = 6, steps = 8;
    int total() const { return values * steps; }
};

/// The runs of a method: one per value of its parameter, all of the same length.
struct SearchPlan {
    std::vector<double> values;   // ascending
    double unit = 1;              // value × unit is DenoisingOptions::parameter
    int steps = 0;
};
/// Plans geometric sequences of values in units of plan.unit: explicit flow, λ from 0.05 to 0.9 of 2/μ_max; Taubin, pass bands from 0.01 to
/// 0.3; other flows, λ from 0.0025 to 2.56 squared mean edges; filters of normals, σ_r from 0.1 to 1. A single value is the
/// geometric mean of both ends.
/// @param mean_edge, largest_eigenvalue  of the noisy mesh [length], [1/length²]
SearchPlan search_plan(DenoisingMethod method, const SearchBudget& budget, double mean_edge, double largest_eigenvalue);

/// One state of a run. Step 0 is the noisy mesh, for which `value` has no meaning.
struct SearchState {
    double value = 0;   // in the plan's unit
    int step = 0;
    double shape = 0;    // shape_rms() against the clean mesh [length]
    double rms = 0;      // vertex_rms() against it [length]
    double angle = 0;    // mean angle of the face normals against the clean ones [rad]
    double volume = 0;   // signed; meaningful if the mesh is closed [length³]
};

struct SearchResult {
    DenoisingMethod method{};
    bool defined = true;                      // false: the method is not defined on this mesh
    SearchState noisy;                        // the start of every run
    SearchState by_shape, by_rms, by_angle;   // the states with the smallest error of each measure
    Positions X;                              // of by_shape
    MeshDifference difference;                // X against the clean mesh
    int steps = 0;                            // done in all runs
    int failed = 0;                           // runs that ended early: blown up, collapsed, or with a system that could not be factored

    // Error of the noisy mesh over the least error reached, ≥ 1; NaN if the method is not defined or the noise has no such error.
    double gain() const;         // of the distance to the surface
    double rms_gain() const;     // of the distance to the vertices' own places
    double angle_gain() const;   // of the angle of normals
};
using Gain = double (SearchResult::*)() const;
inline constexpr double helps = 1.1, works = 2;   // gains from which a method is said to help, and to work

/// One measure of denoising, with a best state of its own.
struct Measure {
    std::string_view key;   // of its words: "surface"
    Gain gain;
    SearchState SearchResult::*best;
    double SearchState::*error;   // [length], of normals [rad]
};
/// Distance to the clean surface, distance to the vertices' own places, angle to the clean normals.
inline constexpr std::array measures{
    Measure{"surface", &SearchResult::gain, &SearchResult::by_shape, &SearchState::shape},
    Measure{"places", &SearchResult::rms_gain, &SearchResult::by_rms, &SearchState::rms},
    Measure{"normals", &SearchResult::angle_gain, &SearchResult::by_angle, &SearchState::angle},
};

/// The clean mesh, its normals, and its noisy copy.
struct SearchInput {
    const TriangleMesh& clean;
    const Positions& clean_normals;
    DenoisingInput noisy;
    double mean_edge = 0;   // of the noisy mesh [length]
};
/// Runs the method for every value of the plan and returns the state with the least error of each measure, the noisy mesh included. Makes
/// no run if the method is not defined on the mesh.
/// @param after_state  called with the state and positions after every step; returning false ends the run
SearchResult search(const SearchInput& input, DenoisingMethod method, const SearchPlan& plan,
                    const std::function<bool(const SearchState&, const Positions&)>& after_state = {});
/// Runs the method by the search_plan() of the budget and returns the best states.
SearchResult search(const SearchInput& input, DenoisingMethod method, const SearchBudget& budget);

}   // namespace meshfolio
