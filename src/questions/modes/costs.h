/// @file
/// What a given smoothness costs, explicit and implicit, and how true to the exact flow each is: known from the spectral measure of the
/// coordinates before anything is run.
#pragma once

#include <iterator>

#include "geometry/linear/sparse_factor.h"
#include "geometry/spectrum/spectral_measure.h"
#include "questions/bench/smoothing_study.h"

namespace meshfolio::modes {

/// One way to reach a target: scheme, step and number of steps.
struct SmoothingWay {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;       // [length²]
    int steps = 0;           // 0: more than are counted
    double energy = 0;       // reached, of the input
    double error = 0;        // area-weighted rms distance from the exact flow e^{TL}X of the same energy, over the rms motion of that flow
    double operations = 0;   // multiply–adds of steps and factorisation, three coordinates
};

/// Closed forms on one mesh; all energies are shares of the input's.
class CostModel {
public:
    static constexpr int most_steps = 1'000'000;

    CostModel(const SmoothingSubject& subject, SpectralMeasure measure);

    const SpectralMeasure& measure() const { return measure_; }
    const FactorOperations& factor() const { return factor_; }
    double explicit_step_operations() const { return 3 * nonzeros_; }
    double implicit_step_operations() const { return 3 * (factor_.solve + rows_); }

    /// The fewest steps at 0.95 λ_crit with at most the energy asked for.
    SmoothingWay explicit_way(double energy) const;
    /// `steps` of the λ that gives exactly this energy.
    SmoothingWay implicit_way(double energy, int steps) const;
    /// The fewest implicit steps to this energy with at most this error.
    SmoothingWay implicit_way_within(double energy, double error) const;
    /// The least energy of which one implicit step, the way that is hardest to foretell, is foretold to 10⁻⁷; at least `least`.
    double least_energy(double least) const;
    /// Diffusion time after which the exact flow has this energy. [length²]
    double exact_time(double energy) const;

private:
    template <class Filter>
    double share(Filter filter) const {
        return measure_.energy(filter) / energy_;
    }
    template <class Filter>
    double error_of(Filter filter, double energy) const;

    SpectralMeasure measure_;
    FactorOperations factor_;
    double critical_, energy_, rows_, nonzeros_;
};

/// One target energy and the ways to reach it.
struct SmoothingTarget {
    double energy = 0;   // share of the input's
    SmoothingWay explicit_way;
    std::vector<SmoothingWay> implicit_ways;   // in the order of implicit_way_names()
};
inline constexpr int implicit_steps[] = {1, 3, 10};
inline constexpr double implicit_accuracy = 0.01;   // of the way that takes as many steps as that needs
/// Places among the implicit ways of the one within that accuracy, and of the one as true as the explicit way.
inline constexpr std::size_t accurate_way = std::size(implicit_steps), matched_way = accurate_way + 1;
inline constexpr std::size_t implicit_way_count = matched_way + 1;

/// "implicit, 1 step", …, "implicit, error ≤ 1 %", "implicit, as true as explicit".
Names implicit_way_names();

SmoothingTarget smoothing_target(const CostModel& model, double energy);

/// Costs less than the explicit way, which may not get there at all.
bool is_cheaper(const SmoothingWay& way, const SmoothingWay& explicit_way);

/// The first of the targets, whose energies descend, from which on the implicit way `which` is cheaper to the end; empty: none.
std::optional<std::size_t> cheaper_from(const std::vector<SmoothingTarget>& targets, std::size_t which);
/// Finds the target where that begins, between that one and the one before it.
std::optional<SmoothingTarget> crossing_of(const CostModel& model, const std::vector<SmoothingTarget>& targets, std::size_t which);

}   // namespace meshfolio::modes
