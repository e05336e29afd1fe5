/// @file
/// The parts of question 7.
#pragma once

#include "questions/q7_denoising/reasons.h"

namespace meshfolio::q7_denoising {

inline constexpr report::Words words("q7");
extern const LabOffer lab;

using Grids = std::vector<DenoisingGrid>;
using Case = Within<DenoisingGrid, NoisyTrial>;

inline std::vector<Case> cases_of(const Grids& grids) { return parts_within(grids, &DenoisingGrid::trials); }
/// What labels tell of a trial, in names and numbers; its best by the distance to the surface.
report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial);
/// What the discussion and the answer tell.
report::Facts facts_of(const Grids& grids, const Reasons& reasons);

inline constexpr auto distance_colours = "pale";

/// Shows each mesh clean, noisy, nearest to the clean surface, and smoothed further, at the noise to look at.
void add_states(Answer& answer, const Grids& grids);
/// What the strongest noise leaves, from six directions.
void add_views(Answer& answer, const Grids& grids);
/// What the same smoothing takes from clean meshes: edges and volume, each where it shows most.
void add_losses(Answer& answer, const Grids& grids);
/// The grid whose noise to look at shows most of it; null where none does. Drift: where smoothing removes less along the surface than
/// across.
const DenoisingGrid* most_drifting(const Grids& grids);
const DenoisingGrid* most_rounded(const Grids& grids);
const DenoisingGrid* most_shrunk(const Grids& grids);
/// The grid with the largest gain by surface.
const DenoisingGrid& leading(const Grids& grids);

report::Table result_table(const Grids& grids);
/// Gains by the other measures, and by a rule that needs no clean mesh.
report::Table measure_table(const Grids& grids);
/// What is left at the noise to look at.
report::Table remains_table(const Grids& grids);
report::Plot mode_plot(const Reasons& reasons);
report::Plot error_plot(const Reasons& reasons);
/// The gain over λ × t, one panel a level of noise.
report::Map gain_map(const DenoisingGrid& grid);

}   // namespace meshfolio::q7_denoising
