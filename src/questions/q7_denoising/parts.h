/// @file
/// The parts of question 7.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::q7_denoising {

inline constexpr report::Words words("q7");
extern const LabOffer lab;

struct DenoisingGrid;   // study.h
struct Reasons;
using Grids = std::vector<DenoisingGrid>;
/// Runs the grid of each mesh; a mesh that cannot be smoothed becomes a failed check.
std::shared_ptr<const Grids> denoising_grids(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                             report::Section& section);
/// Finds the modes and error curves of the smallest mesh with a gain. The grids must outlive them.
std::shared_ptr<const Reasons> shared_reasons(const Grids& grids);

/// Returns the facts of the discussion and of the answer.
report::Facts facts_of(const Grids& grids, const Reasons& reasons);

/// Adds a figure of pictured() of each mesh: clean, noisy, nearest to the clean surface, and smoothed further.
void add_states(Answer& answer, const Grids& grids);
/// Adds a figure of the best results at the strongest noise, from six directions.
void add_views(Answer& answer, const Grids& grids);
/// Adds a figure of clean meshes smoothed alike: the one that loses most of its edges, and the one that loses most of its volume.
void add_losses(Answer& answer, const Grids& grids);
/// Returns the grid with the largest gain by surface.
const DenoisingGrid& grid_with_largest_gain(const Grids& grids);

/// Returns a table of the gain, the volume and the verdict of every trial.
report::Table result_table(const Grids& grids);
/// Returns a table of the gains by all measures, and by a rule that needs no clean mesh.
report::Table measure_table(const Grids& grids);
/// Returns a table of the errors left in pictured() of each mesh.
report::Table remains_table(const Grids& grids);
/// Adds the plots of modes and of errors, as far as they are known.
void add_reason_plots(report::Section& section, const Reasons& reasons);
/// Maps the gain over λ × t, one panel a level of noise.
report::Map gain_map(const DenoisingGrid& grid);

void add_checks(report::Section& section, const Grids& grids);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Grids& grids, const QuestionSettings& settings);

}   // namespace meshfolio::q7_denoising
