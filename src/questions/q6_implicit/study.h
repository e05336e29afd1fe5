/// @file
/// The measurements of question 6: implicit and explicit smoothing over a grid of steps and iterations, and their costs.
#pragma once

#include "questions/bench/smoothing_study.h"

namespace meshfolio::q6_implicit {

/// One cell of the grid λ × iterations, both schemes.
struct SmoothingCell {
    double lambda = 0;
    int iterations = 0;
    Positions implicit_X, explicit_X;   // explicit_X is empty once the explicit run has blown up
    double implicit_energy = 0, explicit_energy = 0;
    int explicit_blow_up = 0;   // iteration; 0: none
    double kept = 1;            // least share of the size of any component that the implicit run left until here
    int inverted_faces = 0;     // of the implicit result
    int fewer_steps = 0;        // fewest steps of a larger λ with the same λt; 0: none are in the grid
    double apart = NAN;         // distance of the implicit result from that of the fewer steps, over the distance moved

    bool collapsed() const { return implicit_energy < 1e-12; }   // to a point
    bool has_explicit() const { return explicit_X.size() > 0; }
    double time() const { return lambda * iterations; }   // λt [length²]
};

/// Costs of the steps of both schemes, counted on the matrices. [multiply–adds]
struct StepPrices {
    double explicit_step = 0;
    double implicit_step = 0;   // 0: not counted, as conjugate gradients take a varying number of iterations
    double factorisation = 0;   // once for all steps of one λ

    bool counted() const { return explicit_step > 0 && implicit_step > 0; }
};

/// The recommended result compared with explicit steps of half of λ_crit to the same energy.
struct SmoothingCost {
    int explicit_steps = 0;                             // 0: more than were tried
    double ratio = NAN;                                 // of the operations, explicit over implicit
    double roughness = NAN, explicit_roughness = NAN;   // median angle between neighbouring faces [°]
    Vector gap = {};                                    // n distances to the explicit result of equal λt [length]; empty: too many steps
    double gap_share = NAN;                             // rms of the gap, over that of the distance moved

    bool reached() const { return explicit_steps > 0; }
};

/// The least number of iterations from which on implicit steps of a λ cost no more than explicit steps to equal energy.
struct BreakEven {
    double lambda = 0;
    int iterations = 0;
    double kept = 1;   // share of the size left by then

    double time() const { return lambda * iterations; }   // λt [length²]
};

/// Smoothing goes too far if it leaves less than this share of the size.
inline constexpr double too_little = 0.5;

/// The distance between the results of the two schemes.
struct SchemeGap {
    int iterations = 0;
    double share = 0;   // rms distance over the distance moved
};

struct ImplicitStudy {
    SmoothingSubject subject;
    double roughness = 0;   // median angle between neighbouring faces of the input [°]
    std::vector<double> lambdas;
    std::vector<int> iterations;
    std::vector<SmoothingCell> grid;                          // λ by λ, iterations ascending
    std::vector<SmoothingRun> implicit_runs, explicit_runs;   // one a λ
    double worst_damping = 0;                                 // largest relative deviation from (1 + λμ)^−t
    int damped_modes = 0;                                     // number of modes measured for worst_damping
    double huge_step_energy = 0;                              // after one implicit step of 10⁶ λ_crit, over that of the input
    std::optional<SmoothingCell> recommended;                 // see good()
    std::optional<SmoothingCost> cost;                        // of the recommended result
    StepPrices prices;
    std::vector<double> explicit_energy;   // after n = 0, 1, … explicit steps of half of λ_crit, over that of the input

    const std::string& name() const { return subject.name(); }
    const SmoothingCell& cell(std::size_t lambda, std::size_t t) const { return grid[lambda * iterations.size() + t]; }
    /// Returns the index of the largest λ within the explicit limit; none if all are beyond.
    std::optional<std::size_t> within_limit() const;
    /// Returns the gaps between the schemes at the λ of within_limit(), for each iteration count that leaves 0.1 % of the energy or more.
    std::vector<SchemeGap> gaps() const;
    /// Returns the index of the smallest λ with an explicit run that blew up.
    std::optional<std::size_t> first_blown() const;
    /// Returns the recommended result: of those that keep 95 % of the size and come within 1 % of the least energy, the one with the fewest
    /// steps. Null if one step of every λ already goes too far.
    const SmoothingCell* good() const { return recommended ? &*recommended : nullptr; }
    /// Returns the least number of explicit steps of half of λ_crit that leave at most this share of the input's energy; 0 if none are
    /// needed, or more than were tried.
    int explicit_steps_to(double energy) const;
    /// Returns the price of t implicit steps of lambdas[l]: the operations of explicit steps to their energy, over those of the implicit
    /// steps with the factorisation; NaN if prices are not counted or the explicit steps are unknown.
    double price(std::size_t l, int t) const;
    /// Returns from which iteration on price(l, t) stays at least 1, as far as it is known (BreakEven); none if the last known price is
    /// below 1, or if none is known.
    std::optional<BreakEven> break_even(std::size_t l) const;
    /// Returns the break-even that leaves most of the size, over all λ; none if no λ has one.
    std::optional<BreakEven> break_even() const;
    /// Returns the first iteration of lambdas[l] that leaves less than `too_little` of the size; 0 if none does.
    int too_far(std::size_t l) const;
    /// Returns the cell of equal λt with the fewest steps; null if none has fewer than `cell`.
    const SmoothingCell* in_fewer_steps(const SmoothingCell& cell) const;
};

/// The largest number of explicit steps in prices.
inline constexpr int most_priced_steps = 1000;

/// Default steps, in multiples of the explicit limit: within it, a little beyond, far beyond.
inline const std::vector<double> own_steps{0.5, 5.0, 50.0};
/// Returns the iteration counts of the grid, ascending: those of the settings, else 1, 3, 10, 30, 100 (quick: 1, 10).
std::vector<int> iterations_of(const QuestionSettings& settings);

/// Smooths the mesh by both schemes with every λ of the settings, else of own_steps, and finds the recommended result and its cost.
ImplicitStudy implicit_study(SharedMesh source, const QuestionSettings& settings);

/// Converts a λt to squared mean edges.
inline double in_edges(const ImplicitStudy& study, double time) { return time / (study.subject.mean_edge * study.subject.mean_edge); }

}   // namespace meshfolio::q6_implicit
