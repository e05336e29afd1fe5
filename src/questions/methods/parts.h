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
/// Lists the meshes and their classes.
report::Table subject_table(const DenoisingLaboratory& laboratory);
/// Shows the gain of every method in shape and the largest gains in places and normals, one row per noisy mesh.
report::Table gain_table(const DenoisingLaboratory& laboratory);
/// Shows the best methods of each class.
report::Table winner_table(const DenoisingLaboratory& laboratory);
/// Plots the gain over the level of Gaussian noise for methods that differ, one panel per mesh; not for a single level.
void add_gain_plot(report::Section& section, const DenoisingLaboratory& laboratory);
/// Adds small pictures of the clean mesh, the noisy one and the best results of the methods in the plot, one row per noisy mesh.
/// @param box_levels  also of the noise by the box on the first mesh
void add_method_figure(Answer& answer, const DenoisingLaboratory& laboratory, bool box_levels);

void add_checks(report::Section& section, const DenoisingLaboratory& laboratory);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const DenoisingLaboratory& laboratory, const QuestionSettings& settings);

/// Returns the answer of the section: the best methods and their classes.
report::Text answer_of(const DenoisingLaboratory& laboratory);
/// Collects the facts of the discussion.
report::Facts facts_of(const DenoisingLaboratory& laboratory);

}   // namespace meshfolio::methods
