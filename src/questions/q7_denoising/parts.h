/// @file
/// The parts of question 7.
#pragma once

#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {

inline constexpr report::Words words("q7");

using Grids = std::vector<DenoisingGrid>;
using Case = Within<DenoisingGrid, NoisyTrial>;

inline std::vector<Case> cases_of(const Grids& grids) { return parts_within(grids, &DenoisingGrid::trials); }
/// What sentences about a trial may tell, in names and numbers, and what else is given; its best by the distance to the surface.
report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial, report::Facts more = {});

inline constexpr auto distance_colours = "pale";

/// The verdicts by a measure, of the cases that have it: noise within a plane changes neither surface nor normals.
struct Count {
    int works = 0, helps = 0, fails = 0;
    Names shrinking;   // of those that fail, the cases whose gain cost too much volume

    int cases() const { return works + helps + fails; }
};
Count count_of(const Grids& grids, const Measure& measure);

/// The cases to look at: of each mesh its own, and of all the one with the least and the one with the largest gain.
std::vector<Case> pictured_cases(const Grids& grids);
/// Shows each case clean, noisy, nearest to the clean surface, and smoothed further. @return  the colours of the figure
output::ColorRange add_states(Answer& answer, const Grids& grids);
/// The nearest of these from the six directions, in the same colours.
void add_views(Answer& answer, const Grids& grids, const output::ColorRange& colours);
/// What smoothing cannot do: drift, rounded edges, lost volume, each where it shows most.
void add_limits(Answer& answer, const Grids& grids);
/// Whose noise to look at shows most of it; null where none does. Drift: where smoothing removes less along the surface than across it.
const DenoisingGrid* most_drifting(const Grids& grids);
const DenoisingGrid* most_rounded(const Grids& grids);
const DenoisingGrid* most_shrunk(const Grids& grids);
/// The one whose surface gains most, of which the map is looked at, and the one with the least gain.
const DenoisingGrid& leading(const Grids& grids);
const DenoisingGrid& hardest(const Grids& grids);
/// Find the noise of one grid with the largest and with the least gain; the first where none has any.
const NoisyTrial& leading_in(const DenoisingGrid& grid);
const NoisyTrial& hardest_in(const DenoisingGrid& grid);

report::Table result_table(const Grids& grids);
/// How often smoothing works, helps and fails by each measure.
report::Table count_table(const Grids& grids);
/// Errors, λ and t behind them, measure by measure.
report::Table measure_table(const Grids& grids);
/// What is left at the noise to look at.
report::Table remains_table(const Grids& grids);
/// Distance to the surface over the iterations, at the step in the middle.
report::Plot error_plot(const DenoisingGrid& grid);
/// The gain over λ × t, one panel a level of noise.
report::Map gain_map(const DenoisingGrid& grid);

/// The few sentences that stand first, in bold, and those behind them.
report::Text answer_of(const Grids& grids);
report::Text summary_of(const Grids& grids);
/// Why it pays or fails, where the surface is missed, which noise is too strong, how much smoothing it takes, what it cannot do.
report::Text explanation_of(const Grids& grids);
report::Text reading_of(const Grids& grids);
report::Text strength_of(const Grids& grids);
report::Text amount_of(const Grids& grids);
report::Text limits_of(const Grids& grids);
/// Who has no clean mesh, and other noise.
report::Text beyond_of(const Grids& grids);

}   // namespace meshfolio::q7_denoising
