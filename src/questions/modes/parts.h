/// @file
/// The parts of the section "modes": the effect of a filter on the shape, and on noise.
#pragma once

#include "questions/modes/mode_study.h"
#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {

inline constexpr report::Words words("modes");

// ---- the shape

/// Plots the factors of the modes of one mesh, by law and measured, at three steps.
report::Plot damping_plot(const ModeStudy& study);
/// Compares the results of the two schemes, one row per step of each mesh.
report::Table gap_table(const ModeStudies& studies);
/// Plots the operations over the energy left, one panel per mesh.
report::Plot cost_plot(const ModeStudies& studies);
/// Plots the distance from the exact flow over the energy left, one panel per mesh.
report::Plot truth_plot(const ModeStudies& studies);
/// Shows the energies from which the implicit ways are cheaper.
report::Table crossing_table(const ModeStudies& studies);
/// Collects the facts of the words on the shape.
report::Facts shape_facts(const ModeStudies& studies);

// ---- noise

// Tables have one row per level of each mesh, plots one panel per mesh.

/// Compares expected and measured errors with the clean mesh's operator.
report::Table expected_table(const PredictionStudies& studies);
/// Compares predicted and measured errors with the noisy mesh's own operator.
report::Table own_operator_table(const PredictionStudies& studies);
/// Shows the parts of the measured error where the formula is farthest from it.
report::Table why_table(const PredictionStudies& studies);
/// Compares the rules that choose the iteration.
report::Table rule_table(const PredictionStudies& studies);
/// Plots expected and measured errors with the clean mesh's operator, at all levels.
report::Plot expected_plot(const PredictionStudies& studies);
/// Plots the measured errors with the noisy mesh's own operator and all predictions, at the highest level.
report::Plot own_operator_plot(const PredictionStudies& studies);
/// Collects the facts of the words on noise.
report::Facts noise_facts(const PredictionStudies& studies);

}   // namespace meshfolio::modes
