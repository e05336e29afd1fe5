/// @file
/// What question 6 measures: implicit beside explicit smoothing over a grid of steps and iterations, and what both cost.
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
    double volume_ratio = 0;    // of the implicit result; NaN when open
    double kept = 1;            // of the size: the least share that the implicit run left of any component until here
    int inverted_faces = 0;     // of the implicit result
    int fewer_steps = 0;        // of a larger λ and the same λt; 0: none are in the grid
    double apart = NAN;         // the implicit result from theirs, over the distance moved

    bool collapsed() const { return implicit_energy < 1e-12; }   // to a point
    bool has_explicit() const { return explicit_X.size() > 0; }
    double time() const { return lambda * iterations; }   // λt [length²]
};

/// What the steps of both schemes cost, counted on the matrices. [multiply–adds]
struct StepPrices {
    double explicit_step = 0;
    double implicit_step = 0;   // 0: not counted, as by conjugate gradients, whose number of iterations varies
    double factorisation = 0;   // once for all steps of one λ

    bool counted() const { return explicit_step > 0 && implicit_step > 0; }
};

/// What is recommended, beside explicit steps of half of λ_crit to the same energy.
struct SmoothingCost {
    int explicit_steps = 0;                             // 0: more than were tried
    double ratio = NAN;                                 // of the operations, explicit over implicit
    double roughness = NAN, explicit_roughness = NAN;   // median angle between neighbouring faces [°]
    Vector gap = {};                                    // n distances to the explicit result of equal λt [length]; empty: too many steps
    double gap_share = NAN;                             // their rms, over that of the distance moved

    bool reached() const { return explicit_steps > 0; }
};

/// The iterations from which on implicit steps of a λ cost no more than explicit ones to the same energy.
struct BreakEven {
    double lambda = 0;
    int iterations = 0;
    double kept = 1;   // of the size, then

    double time() const { return lambda * iterations; }   // λt [length²]
};

/// Smoothing goes too far once it leaves less than this share of the size.
inline constexpr double too_little = 0.5;

/// How far apart the two schemes end after t steps, over the distance moved.
struct SchemeGap {
    int iterations = 0;
    double share = 0;
};

struct ImplicitStudy {
    SmoothingSubject subject;
    double roughness = 0;   // median angle between neighbouring faces of the input [°]
    std::vector<double> lambdas;
    std::vector<int> iterations;
    std::vector<SmoothingCell> grid;                          // λ by λ, iterations ascending
    std::vector<SmoothingRun> implicit_runs, explicit_runs;   // one a λ
    double worst_damping = 0;                                 // largest relative deviation from (1 + λμ)^−t
    int damped_modes = 0;                                     // modes that went into it
    double huge_step_energy = 0;                              // after one implicit step at a million times the explicit limit, of input
    std::optional<SmoothingCell> recommended;                 // as many steps as keep the size; none: one already goes too far
    std::optional<SmoothingCost> cost;                        // of that
    StepPrices prices;
    std::vector<double> explicit_energy;   // after n = 0, 1, … explicit steps of half of λ_crit, over that of the input

    const std::string& name() const { return subject.name(); }
    bool is_closed() const { return subject.preflight().encloses_volume(); }
    const SmoothingCell& cell(std::size_t lambda, std::size_t t) const { return grid[lambda * iterations.size() + t]; }
    /// Index of the largest λ that is within the explicit limit.
    std::optional<std::size_t> within_limit() const;
    /// The gaps at that λ, as long as something is left to smooth.
    std::vector<SchemeGap> gaps() const;
    /// Index of the smallest λ whose explicit run blew up.
    std::optional<std::size_t> first_blown() const;
    /// The most smoothing that leaves 95 % of the size: within 1 % of the least energy, the one with the fewest steps. Null: none.
    const SmoothingCell* good() const { return recommended ? &*recommended : nullptr; }
    /// Explicit steps of half of λ_crit to this share of the energy of the input; 0: none, or more than were tried.
    int explicit_steps_to(double energy) const;
    /// The operations of the explicit steps over those of t implicit steps of the l-th λ; NaN where one is unknown.
    double price(std::size_t l, int t) const;
    /// The break-even of the l-th λ, and the one that leaves most of the size. None: explicit steps are always cheaper.
    std::optional<BreakEven> break_even(std::size_t l) const;
    std::optional<BreakEven> break_even() const;
    /// The first iteration of the l-th λ that leaves less than `too_little` of the size; 0: none does.
    int too_far(std::size_t l) const;
    /// The cell of the same λt in the fewest steps. Null: it is that itself.
    const SmoothingCell* in_fewer_steps(const SmoothingCell& cell) const;
};

/// Explicit steps that prices are counted with, at most.
inline constexpr int most_priced_steps = 1000;

/// Default steps in units of the explicit limit: within it, a little beyond, far beyond.
inline const std::vector<double> own_steps{0.5, 5.0, 50.0};
/// The iteration counts of every step, ascending.
std::vector<int> iterations_of(const QuestionSettings& settings);

/// Uses the steps of the settings, else own_steps.
ImplicitStudy implicit_study(SharedMesh source, const QuestionSettings& settings);

}   // namespace meshfolio::q6_implicit
