/// @file
/// The parts of question 6.
#pragma once

#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

inline constexpr report::Words words("q6");

using Studies = std::vector<ImplicitStudy>;

/// "λ = 5 λ_crit, t = 10".
std::string title_of(const ImplicitStudy& study, const SmoothingCell& cell);

/// The colour range of mean curvature on all inputs, used in every figure.
output::ColorRange colours_of(const Studies& studies);
/// Shows the input and the results over λ × t, explicit above implicit, in the frame of the input.
void add_matrix(Answer& answer, const ImplicitStudy& study, const output::ColorRange& colours, bool has_legend);
/// What is recommended of each mesh, from the six directions.
void add_views(Answer& answer, const Studies& studies, const output::ColorRange& colours);

/// The gap between the schemes over t, a curve a mesh; no curves where no λ is within the limit.
report::Plot gap_plot(const Studies& studies);

/// The few sentences that stand first, in bold, and those behind them.
report::Text answer_of(const Studies& studies);
report::Text summary_of(const Studies& studies);
/// Paragraphs; empty where there is nothing to say.
report::Text rule_of(const Studies& studies);
report::Text reading_of(const ImplicitStudy& study);
report::Text comparison_of(const Studies& studies);
report::Text larger_steps_of(const Studies& studies);
report::Text quality_of(const Studies& studies);
report::Text price_of(const Studies& studies);
report::Text verdict_of(const Studies& studies);

/// A λt in squared mean edges.
inline double in_edges(const ImplicitStudy& study, double time) { return time / (study.subject.mean_edge * study.subject.mean_edge); }
/// Median face angle of a rough input; below it the angle measures the shape [°].
inline constexpr double rough = 5;
/// "smoother", "rougher" or (to 5 %) "alike": a rough mesh after explicit steps, beside implicit ones of equal energy; "": it was not
/// rough.
std::string smoothness_key(const ImplicitStudy& study);

}   // namespace meshfolio::q6_implicit
