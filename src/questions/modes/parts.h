/// @file
/// The parts of the section "modes": the effect of a filter on the shape, and on noise.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::modes {

inline constexpr report::Words words("modes");

// ---- the shape

struct ModeStudy;   // mode_study.h
using ModeStudies = std::vector<ModeStudy>;
/// Studies the meshes in order; a mesh that cannot be smoothed becomes a failed check of `section`.
std::shared_ptr<const ModeStudies> mode_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section);
/// Plots the factors of the modes of the first mesh, by law and measured, at three steps.
report::Plot damping_plot(const ModeStudies& studies);
/// Adds the checks of dampings.
void add_shape_checks(report::Section& section, const ModeStudies& studies);
/// Collects the facts of the words on the shape.
report::Facts shape_facts(const ModeStudies& studies);

// ---- noise

struct PredictionStudy;   // prediction_study.h
using PredictionStudies = std::vector<PredictionStudy>;
/// Studies the meshes in order; a mesh that cannot be smoothed becomes a failed check of `section`.
std::shared_ptr<const PredictionStudies> prediction_studies(const LibraryMeshes& meshes, const QuestionSettings& settings,
                                                            const Progress& progress, report::Section& section);

/// Compares expected and measured errors with the clean mesh's operator, a row for each level of each mesh.
report::Table expected_table(const PredictionStudies& studies);
/// Compares predicted and measured errors with the noisy mesh's own operator, a row for each level of each mesh.
report::Table own_operator_table(const PredictionStudies& studies);
/// Shows error_account(), the parts of the measured error where the formula is farthest from it, a row for each level of each mesh.
report::Table why_table(const PredictionStudies& studies);
/// Compares the rules that choose the iteration, a row for each level of each mesh: chosen iteration and regret of the rules in columns.
report::Table rule_table(const PredictionStudies& studies);
/// Plots expected and measured errors with the clean mesh's operator at all levels over the iterations, a panel for each mesh.
report::Plot expected_plot(const PredictionStudies& studies);
/// Plots the measured errors with the noisy mesh's own operator and all predictions at the highest level over the iterations, a panel for
/// each mesh.
report::Plot own_operator_plot(const PredictionStudies& studies);
void add_noise_checks(report::Section& section, const PredictionStudies& studies);
/// Returns the values that the messages on noise in templates/words/modes.md name.
report::Facts noise_facts(const PredictionStudies& studies);

/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const ModeStudies& shapes, const PredictionStudies& noisy, const QuestionSettings& settings);

}   // namespace meshfolio::modes
