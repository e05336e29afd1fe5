/// @file
/// The parts of the chapter on predicted denoising.
#pragma once

#include "questions/prediction/study.h"

namespace meshfolio::prediction {

inline constexpr report::Words words("prediction");

using Studies = std::vector<PredictionStudy>;

/// Relative [1]. Beyond this a deviation is told as "more than" it: a derivative near a collapse has no bound.
inline constexpr double deviation_shown = 10;

/// Every level of every mesh: its study as `whole`, itself as `part`.
inline auto levels_of(const Studies& studies) { return parts_within(studies, &PredictionStudy::levels); }

report::Table clean_prediction_table(const Studies& studies);
report::Table operator_prediction_table(const Studies& studies);
report::Table why_table(const Studies& studies);
report::Table rule_table(const Studies& studies);

/// The clean mesh's operator at all levels.
report::Plot clean_prediction_plot(const PredictionStudy& study);
/// The noisy mesh's own operator, or the rebuilt one, and every prediction, at the highest level.
report::Plot operator_prediction_plot(const PredictionStudy& study, FlowOperator kind);

void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::prediction
