/// @file
/// What the section "modes" shows of its two parts: what a filter does to the shape, and to noise.
#pragma once

#include "questions/modes/mode_study.h"
#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {

inline constexpr report::Words words("modes");

// ---- the shape

/// What the filters leave of each mode of one mesh, by law and measured, at three steps.
report::Plot damping_plot(const ModeStudy& study);
report::Table gap_table(const ModeStudies& studies);
/// Operations, and the distance from the exact flow, over the energy that is left; a panel each mesh.
report::Plot cost_plot(const ModeStudies& studies);
report::Plot truth_plot(const ModeStudies& studies);
report::Table crossing_table(const ModeStudies& studies);

/// What the words say of it.
report::Facts shape_facts(const ModeStudies& studies);

// ---- noise

report::Table expected_table(const PredictionStudies& studies);
report::Table own_operator_table(const PredictionStudies& studies);
report::Table why_table(const PredictionStudies& studies);
report::Table rule_table(const PredictionStudies& studies);
/// The clean mesh's operator at all levels; the noisy mesh's own with every prediction, at the highest. A panel each mesh.
report::Plot expected_plot(const PredictionStudies& studies);
report::Plot own_operator_plot(const PredictionStudies& studies);

report::Facts noise_facts(const PredictionStudies& studies);

}   // namespace meshfolio::modes
