/// @file
/// The parts of question 6.
#pragma once

#include <vector>

#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

inline constexpr report::Words words("q6");

using Studies = std::vector<ImplicitStudy>;

// Figures.
/// Steps, pairs of both schemes, iterations.
void add_figures(Answer& answer, const ImplicitStudy& study);
/// The largest step that leaves something to be seen at the middle number of iterations: three quarters of the size.
void add_before_after(Answer& answer, const ImplicitStudy& study, const std::string& colormap);

// Tables.
report::Table grid_table(const ImplicitStudy& study);
report::Table cost_table(const Studies& studies);

/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::q6_implicit
