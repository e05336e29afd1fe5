/// @file
/// The best that a denoising method can do on one noisy mesh when the clean one is known: question 7 for implicit smoothing over a grid of
/// steps, the denoising laboratory for every method within the same number of steps.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/denoising/denoising_methods.h"
#include "geometry/measures/mesh_error.h"

namespace meshfolio {

/// values × steps is the budget. Methods bound by the stability limit spend it on half as many values and twice as many steps.
struct SearchBudget {
    int values = 6, steps = 8;
    int total() const { return values * steps; }
};

/// The runs a method makes: one a value of its parameter, all of the same length.
struct SearchPlan {
    std::vector<double> values;   // in the unit below, ascending
    double unit = 1;              // of them, as DenoisingOptions::parameter has it
    int steps = 0;
};
/// Geometric sequences: explicit, λ from 0.05 to 0.9 of 2/μ_max; Taubin, pass bands from 0.01 to 0.3; other flows, λ from 0.0025 to 2.56
/// squared mean edges of the noisy mesh; filters of normals, σ_r from 0.1 to 1.
SearchPlan search_plan(DenoisingMethod method, const SearchBudget& budget, double mean_edge, double largest_eigenvalue);

/// "λ = 0.16 h̄²", "λ = 0.9 λ_crit", "pass band 0.1", "σ_r = 0.35".
std::string parameter_words(DenoisingMethod method, double value);

/// One state of a run; step 0 is the noisy mesh, whose parameter has no meaning.
struct SearchState {
    double value = 0;   // in the plan's unit
    int step = 0;
    double shape = 0;    // shape_rms() against the clean mesh [length]
    double rms = 0;      // vertex_rms() against it [length]
    double angle = 0;    // mean angle of the face normals against the clean ones [rad]
    double volume = 0;   // signed; means something where the mesh is closed [length³]
};

struct SearchResult {
    DenoisingMethod method{};
    bool defined = true;                      // the method is, on this mesh
    SearchState noisy;                        // where all begin
    SearchState by_shape, by_rms, by_angle;   // where each measure is smallest
    Positions X;                              // at the best shape
    MeshDifference difference;                // of these from the clean mesh
    int steps = 0;                            // made
    int failed = 0;   // runs that ended before their time: blown up, collapsed, or a system that could not be factored

    /// Error of the noisy mesh over the least error reached, ≥ 1; NaN where the method is not defined or the noise has no such error.
    double gain() const;   // of shape
    double rms_gain() const;
    double angle_gain() const;
};
using Gain = double (SearchResult::*)() const;
inline constexpr double helps = 1.1, works = 2;   // gains from which a method is said to

/// What denoising is judged by. Each measure has its own best state.
struct Measure {
    std::string_view key;   // "surface": of its words
    Gain gain;
    SearchState SearchResult::*best;
    double SearchState::*error;   // [length], of normals [rad]

    bool is_angle() const { return error == &SearchState::angle; }
};
/// Distance to the clean surface, to the vertices' own places, angle to the clean normals.
inline constexpr std::array measures{
    Measure{"surface", &SearchResult::gain, &SearchResult::by_shape, &SearchState::shape},
    Measure{"places", &SearchResult::rms_gain, &SearchResult::by_rms, &SearchState::rms},
    Measure{"normals", &SearchResult::angle_gain, &SearchResult::by_angle, &SearchState::angle},
};

/// The clean mesh and its noisy copy, and what all methods need of them.
struct SearchInput {
    const TriangleMesh& clean;
    const Positions& clean_normals;
    DenoisingInput noisy;
    double mean_edge = 0;   // of the noisy mesh [length]
};
/// @param after_state  called with every state and its positions; false ends the run
SearchResult search(const SearchInput& input, DenoisingMethod method, const SearchPlan& plan,
                    const std::function<bool(const SearchState&, const Positions&)>& after_state = {});
SearchResult search(const SearchInput& input, DenoisingMethod method, const SearchBudget& budget);

}   // namespace meshfolio
