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
/// Runs denoising_grid() of each mesh; a mesh that cannot be smoothed becomes a failed check of `section`.
std::shared_ptr<const Grids> denoising_grids(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                             report::Section& section);
/// Returns reasons_of(grids): the modes and error curves of the smallest mesh with a gain. The grids must outlive the result.
std::shared_ptr<const Reasons> shared_reasons(const Grids& grids);

/// Returns the facts of the discussion and of the answer.
report::Facts facts_of(const Grids& grids, const Reasons& reasons);

/// Adds a figure with a row for pictured() of each mesh: clean, noisy, nearest to the clean surface, and after four times the iterations.
void add_states(Answer& answer, const Grids& grids);
/// Adds a figure of the results nearest to the clean surface at the strongest noise, from six directions; none if no mesh has a gain there.
void add_views(Answer& answer, const Grids& grids);
/// Adds a figure of two clean meshes smoothed like pictured(): most_rounded() and most_shrunk(), as far as there are such.
void add_losses(Answer& answer, const Grids& grids);
/// Returns the grid of the trial with the largest gain by surface, the first of equals.
const DenoisingGrid& grid_with_largest_gain(const Grids& grids);

/// Returns a table with a row for each trial of each mesh: σ, best λt, gain by surface and its spread, volume, verdict.
report::Table result_table(const Grids& grids);
/// Returns a table with a row for each trial of each mesh: gain, λ and t by each of `measures`, and the gain of a rule that needs no clean
/// mesh (Stopped).
report::Table measure_table(const Grids& grids);
/// Returns a table with a row for the noisy trial pictured() of each mesh: error removed along and across the surface, angles of normals,
/// and volume left.
report::Table remains_table(const Grids& grids);
/// Adds a plot of shape and noise mode by mode, and one of the error over λt; each only if it is known.
void add_reason_plots(report::Section& section, const Reasons& reasons);
/// Maps the gain by surface over iteration t and λ, a panel for each level of noise; B marks the best.
report::Map gain_map(const DenoisingGrid& grid);

void add_checks(report::Section& section, const Grids& grids);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Grids& grids, const QuestionSettings& settings);

}   // namespace meshfolio::q7_denoising
