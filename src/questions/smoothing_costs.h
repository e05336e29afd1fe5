/// @file
/// What a given smoothness costs, explicit and implicit, and how true to the exact flow each is: known from the spectral measure of the
/// coordinates before anything is run.
#pragma once

#include <vector>

#include "geometry/factor_operations.h"
#include "geometry/spectral_measure.h"
#include "questions/smoothing_study.h"

namespace meshfolio {

/// One way to a target.
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
    /// The fewest implicit steps that are at least as true to the exact flow.
    SmoothingWay as_true_as(const SmoothingWay& way) const;
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

/// One target and the ways to it.
struct SmoothingTarget {
    double energy = 0;   // share of the input's
    SmoothingWay explicit_way;
    std::vector<SmoothingWay> implicit_ways;   // one an entry of implicit_steps
    SmoothingWay matched;                      // implicit, as true as the explicit way
};
inline constexpr int implicit_steps[] = {1, 3, 10};
SmoothingTarget smoothing_target(const CostModel& model, double energy);

/// Costs less than the explicit way, which may not get there at all.
bool is_cheaper(const SmoothingWay& way, const SmoothingTarget& target);

}   // namespace meshfolio
