/// @file
/// The parts of the section "modes": the effect of a filter on the shape, and on noise.
#pragma once

#include "questions/modes/mode_study.h"
#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {

inline constexpr report::Words words("modes");

// ---- the shape

/// Plots |factor| of the modes of one mesh over μ/μ_max by law and as measured, explicit and implicit, a panel for each of three step
/// sizes.
report::Plot damping_plot(const ModeStudy& study);
/// Compares the results of the two schemes, a row for each λ of each mesh: motion and gap at each count of iterations in columns.
report::Table gap_table(const ModeStudies& studies);
/// Plots the operations of the explicit way and four implicit ways over the energy left, a panel for each mesh; markers show crossings.
report::Plot cost_plot(const ModeStudies& studies);
/// Plots SmoothingWay::error [%] of the explicit way and three implicit ways over the energy left, a panel for each mesh.
report::Plot truth_plot(const ModeStudies& studies);
/// Shows the energy from which each implicit way is cheaper than the explicit one, a row for each mesh; empty if it never is.
report::Table crossing_table(const ModeStudies& studies);
/// Collects the facts of the words on the shape.
report::Facts shape_facts(const ModeStudies& studies);

// ---- noise

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
/// Returns the values that the messages on noise in templates/words/modes.md name.
report::Facts noise_facts(const PredictionStudies& studies);

}   // namespace meshfolio::modes
