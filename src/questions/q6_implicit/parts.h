/// @file
/// The parts of question 6.
#pragma once

#include <vector>

#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

inline constexpr report::Words words("q6");

using Studies = std::vector<ImplicitStudy>;

/// "λ = 5 λ_crit, t = 10".
std::string title_of(const ImplicitStudy& study, const SmoothingCell& cell);

// Figures.
/// Over λ × t, in the frame of the input: the input, explicit above implicit results, explicit until it blows up.
void add_matrix(Answer& answer, const ImplicitStudy& study);
/// What is recommended of each mesh, from the six directions.
void add_views(Answer& answer, const Studies& studies);

// Tables.
report::Table grid_table(const ImplicitStudy& study);
/// What is recommended and what is far beyond the explicit limit, with their price.
report::Table cost_table(const Studies& studies);

/// One sentence, and the few that stand first in the section.
report::Text answer_of(const Studies& studies);
report::Text summary_of(const Studies& studies);
/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::q6_implicit
