/// @file
/// The blocks of the section "prediction". Private to the layer.
#pragma once

#include <vector>

#include "questions/prediction/study.h"
#include "report/document.h"

namespace meshfolio::prediction {

report::Table clean_prediction_table(const std::vector<PredictionStudy>& studies);
report::Table operator_prediction_table(const std::vector<PredictionStudy>& studies);
report::Table why_table(const std::vector<PredictionStudy>& studies);
report::Table rule_table(const std::vector<PredictionStudy>& studies);
/// Largest deviation of the expected from the measured error weighted by area, relative to the measured one [1]; clean operator, over all
/// iterations.
double largest_mass_deviation(const PredictionStudy& study, const NoiseLevelStudy& level);
/// Relative [1]. Beyond this a deviation is told as "more than" it: a derivative near a collapse has no bound.
inline constexpr double deviation_shown = 10;

/// The clean mesh's operator at all levels.
report::Plot clean_prediction_plot(const PredictionStudy& study);
/// The noisy mesh's own operator, or the rebuilt one, and every prediction, at the highest level.
report::Plot operator_prediction_plot(const PredictionStudy& study, FlowOperator kind);
std::vector<report::Check> prediction_checks(const std::vector<PredictionStudy>& studies);

/// Where the formula is farthest from what was measured: the mean squared error in shares of that of the noise, 3σ².
struct ErrorAccount {
    int iteration = 0;
    double formula = 0;     // with the clean mesh's operator
    double numbers = 0;     // more, because the operator has other numbers: those of other noisy meshes
    double knowledge = 0;   // more, because it is made from the same noise that it smooths
    double measured = 0;    // the sum of the three
    /// Squared error along the clean surface over that of the noise, 2σ², and across it over σ².
    double along_own = 0, along_clean = 0, across_own = 0, across_clean = 0;
};
ErrorAccount error_account(const NoiseLevelStudy& level);

/// What the numbers say. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<PredictionStudy>& studies);

}   // namespace meshfolio::prediction
