/// @file
/// The parts of question 7.
#pragma once

#include <vector>

#include "questions/core/section_tools.h"
#include "questions/core/table.h"
#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {

inline constexpr report::Words words("q7");

using Grids = std::vector<DenoisingGrid>;
using Case = Within<DenoisingGrid, NoisyTrial>;

inline std::vector<Case> cases_of(const Grids& grids) { return parts_within(grids, &DenoisingGrid::trials); }
/// What sentences about a trial may tell, in names and numbers; its best by the distance to the surface.
report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial);

// Figures.
void add_trial_figure(Answer& answer, const DenoisingGrid& grid, const NoisyTrial& trial);
/// The noise that smoothing did most against.
void add_before_after(Answer& answer, const DenoisingGrid& grid, const std::string& colormap);

// Tables and plots.
report::Table result_table(const Grids& grids);
/// Distance to the surface over the iterations, at the step in the middle.
report::Plot error_plot(const DenoisingGrid& grid);
/// The gain over λ × t, one panel a level of noise.
report::Map gain_map(const DenoisingGrid& grid);

/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Grids& grids);

}   // namespace meshfolio::q7_denoising
