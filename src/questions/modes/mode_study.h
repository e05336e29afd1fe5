/// @file
/// The damping of each eigenmode, the gap between the two schemes, and the cost of a given smoothness, explicit and implicit. The spectral
/// measure of the coordinates predicts cost and error before anything is run.
#pragma once

#include <iterator>

#include "geometry/linear/sparse_factor.h"
#include "geometry/spectrum/spectral_measure.h"
#include "questions/bench/smoothing_study.h"
#include "questions/modes/parts.h"

namespace meshfolio::modes {

/// Returns the factor that some steps leave of a mode: (1 − λμ)ᵗ or (1 + λμ)⁻ᵗ.
double damping_law(SmoothingScheme scheme, double lambda, int steps, double mu);

/// One way to reach a target: scheme, step and number of steps.
struct SmoothingWay {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;       // [length²]
    int steps = 0;           // 0: more than CostModel::most_steps
    double energy = 0;       // reached, over that of the input
    double error = 0;        // area-weighted rms distance from the exact flow e^{TL}X of the same energy, over the rms motion of that flow
    double operations = 0;   // multiply–adds of steps and factorisation, three coordinates
};

/// Closed forms for one mesh. Energies are shares of the input's; operations are multiply–adds.
struct CostModel {
    static constexpr int most_steps = 1'000'000;

    SpectralMeasure measure;   // of the input's coordinates
    FactorOperations factor;
    double explicit_step = 0, implicit_step = 0;   // operations of one step, three coordinates
    double critical = 0;                           // λ_crit [length²]
    double initial_energy = 0;                     // [length²]

    CostModel() = default;
    CostModel(const SmoothingSubject& subject, SpectralMeasure of_input);
    /// Returns the energy that a filter f(−L) leaves, over that of the input. @param filter  f(μ)
    double share(const auto& filter) const { return measure.energy(filter) / initial_energy; }
    /// Returns the way with the fewest explicit steps of 0.95 λ_crit that leaves at most this energy; steps = 0 if most_steps are not
    /// enough.
    SmoothingWay explicit_way(double energy) const;
    /// Returns the implicit way with this number of steps and exactly this energy.
    SmoothingWay implicit_way(double energy, int steps) const;
    /// Returns the way with the fewest implicit steps, exactly this energy and at most this error; steps = 0 if 10 000 are not enough.
    SmoothingWay implicit_way_within(double energy, double error) const;
    /// Returns the energy of one implicit step, at least `least`, for the largest λ tried that the measure predicts to 10⁻⁷; that of λ_crit
    /// if none is. One step has the least certain prediction of all ways.
    double least_energy(double least) const;
    /// Returns the diffusion time after which the exact flow has this energy. [length²]
    double exact_time(double energy) const;
};

/// One target energy and the ways to reach it.
struct SmoothingTarget {
    double energy = 0;   // over that of the input
    SmoothingWay explicit_way;
    std::vector<SmoothingWay> implicit_ways;   // in the order of implicit_way_names()
};
inline constexpr int implicit_steps[] = {1, 3, 10};
inline constexpr double implicit_accuracy = 0.01;   // error of the way accurate_way
/// Indices of the implicit ways within implicit_accuracy, and within the error of the explicit way.
inline constexpr std::size_t accurate_way = std::size(implicit_steps), matched_way = accurate_way + 1;
inline constexpr std::size_t implicit_way_count = matched_way + 1;

/// Returns "implicit, 1 step", …, "implicit, error ≤ 1 %", "implicit, as true as explicit".
Names implicit_way_names();

/// Computes the explicit way and all implicit ways to this energy.
SmoothingTarget smoothing_target(const CostModel& model, double energy);

/// True if the implicit way exists and needs fewer operations than the explicit way, or the explicit way does not reach the energy.
bool is_cheaper(const SmoothingWay& way, const SmoothingWay& explicit_way);
/// Returns the index of the first target from which on the implicit way `which` is cheaper to the end; nothing if there is none.
/// @param targets  energies descending
std::optional<std::size_t> cheaper_from(const std::vector<SmoothingTarget>& targets, std::size_t which);
/// Finds the largest energy from which on down the implicit way `which` is cheaper, between the target cheaper_from() and the one before
/// it; the first target if it is cheaper from there on; nothing if cheaper_from() finds none.
std::optional<SmoothingTarget> crossing_of(const CostModel& model, const std::vector<SmoothingTarget>& targets, std::size_t which);

/// Damping by some steps of one scheme, on coordinates that contain each mode with coefficient 1.
struct ModeDamping {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;   // [length²]
    int steps = 0;
    Vector measured;   // factor of each coefficient, with its sign

    double law(double mu) const { return damping_law(scheme, lambda, steps, mu); }
    /// Returns the largest |measured − law|, over the largest of the laws and 1.
    double deviation(const Vector& eigenvalues) const;
};

/// Explicit against implicit at equal λ and t. Distances are area-weighted rms values over the box diagonal.
struct SchemeGap {
    double lambda = 0;   // [length²]
    int steps = 0;
    double motion = 0;      // of the implicit run
    double measured = 0;    // between the two results; NaN if the explicit run blew up
    double predicted = 0;   // from the spectral measure of the input

    double share() const { return measured / motion; }
};

/// A way that was run to check its prediction.
struct TriedWay {
    std::size_t target = 0;   // index
    SmoothingWay way;
    double energy = 0;     // measured, over that of the input
    double rounding = 0;   // possible effect of the rounding of coordinates and weights on the energy, relative
    double seconds = 0;
};

struct ModeStudy {
    SmoothingSubject subject;
    Vector eigenvalues;                  // of the modes measured, ascending [1/length²]
    bool all = false;                    // all modes of the mesh; else the lowest and the top one
    std::vector<ModeDamping> dampings;   // damped_steps explicit ones, then as many implicit ones
    double rounding = 0;                 // of stored coordinates, over the box diagonal
    std::vector<SchemeGap> gaps;         // step by step, each with the same counts of iterations
    CostModel model;
    std::vector<SmoothingTarget> targets;                    // of the ways that are tried
    std::vector<SmoothingTarget> curve;                      // finer, energies descending
    std::vector<std::optional<SmoothingTarget>> crossings;   // of each implicit way with the explicit one
    std::vector<TriedWay> tried;

    const std::string& name() const { return subject.name(); }
    /// True if the measured gap is above 1e8 times the rounding of coordinates, so that it can be compared with its prediction.
    bool is_measurable(const SchemeGap& gap) const { return gap.measured > 1e8 * rounding; }
    /// True if implicit way `which` has no crossing; true if it is cheaper than the explicit way at all energies of the curve.
    bool cheaper_nowhere(std::size_t which) const { return !crossings[which]; }
    bool cheaper_everywhere(std::size_t which) const { return crossings[which] && crossings[which]->energy >= curve.front().energy; }
};
inline constexpr int damped_steps = 3;          // step sizes of the dampings of one scheme
inline constexpr double law_tolerance = 1e-9;   // largest deviation() that passes

/// Returns the number of Lanczos steps of the spectral measure, alike for x, y and z: 100 (quick: 60, laboratory: 160).
int lanczos_steps(const QuestionSettings& settings);
/// Measures dampings, costs, and gaps at the λ and iterations of the settings, else at 0.1, 0.5, 0.9 of λ_crit and 1, 10, 100 iterations.
ModeStudy mode_study(SharedMesh source, const QuestionSettings& settings);

}   // namespace meshfolio::modes
