/// @file
/// The parts of question 5.
#pragma once

#include <vector>

#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {

inline constexpr report::Words words("q5");

using Studies = std::vector<ExplicitStudy>;

// Figures.
/// The input and every step tried.
void add_sweep_figure(Answer& answer, const ExplicitStudy& study);
/// What the recommended step does to the mesh.
void add_before_after(Answer& answer, const ExplicitStudy& study, const std::string& colormap);

// Tables and plots.
report::Table limit_table(const Studies& studies);
report::Table sweep_table(const ExplicitStudy& study);
report::Plot energy_plot(const ExplicitStudy& study);

/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::q5_explicit
