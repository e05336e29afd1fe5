/// @file
/// The parts of the section "methods".
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::methods {

inline constexpr report::Words words("methods");

struct DenoisingLaboratory;   // study.h
/// Tries the methods on meshes of the library; with bundled ones also on an ellipsoid, smooth, closed and small.
std::shared_ptr<const DenoisingLaboratory> denoising_laboratory(const MeshLibrary& library, const QuestionSettings& settings,
                                                                const Progress& progress, report::Section& section);

/// Adds the words on kinds of noise, methods and budget.
void add_method(report::Section& section, const DenoisingLaboratory& laboratory);
/// Returns a table of the meshes, a row each: vertices, mean edge, sharp edges, class.
report::Table subject_table(const DenoisingLaboratory& laboratory);
/// Returns a table with a row for each noisy mesh: the gain of every method in shape, and the largest gains in places and in normals.
report::Table gain_table(const DenoisingLaboratory& laboratory);
/// Returns a table with a row for each class: the methods with the largest mean gain in shape and in normals, and these gains.
report::Table winner_table(const DenoisingLaboratory& laboratory);
/// Plots the gain over the level of Gaussian noise for methods that differ, one panel per mesh; not for a single level.
void add_gain_plot(report::Section& section, const DenoisingLaboratory& laboratory);
/// Adds a figure with a row for each noisy mesh: the clean mesh, the noisy mesh, and the best result of each method in gain_plot().
/// @param box_levels  also of the noise by the box on the first mesh
void add_method_figure(Answer& answer, const DenoisingLaboratory& laboratory, bool box_levels);

void add_checks(report::Section& section, const DenoisingLaboratory& laboratory);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const DenoisingLaboratory& laboratory, const QuestionSettings& settings);

/// Returns the answer of the section: the best methods and their classes.
report::Text answer_of(const DenoisingLaboratory& laboratory);
/// Returns the facts of the discussion.
report::Facts facts_of(const DenoisingLaboratory& laboratory);

}   // namespace meshfolio::methods
