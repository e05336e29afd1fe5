/// @file
/// The parts of question 7.
#pragma once

#include <vector>

#include "questions/bench/denoising_study.h"
#include "questions/core/section_tools.h"
#include "questions/core/table.h"

namespace meshfolio::q7_denoising {

inline constexpr report::Words words("q7");

using Studies = std::vector<DenoisingStudy>;
using Case = Within<DenoisingStudy, DenoisingTrial>;

inline std::vector<Case> cases_of(const Studies& studies) { return parts_within(studies, &DenoisingStudy::trials); }
/// What sentences about a trial may tell, in names and numbers.
report::Facts facts_of(const DenoisingStudy& study, const DenoisingTrial& trial);
/// "at twice the best iteration, but at t = 40 at least and 600 at most".
std::string length_of_runs(const DenoisingStudy& study);

// Figures.
void add_trial_figure(Answer& answer, const DenoisingStudy& study, const DenoisingTrial& trial);
/// The noise that smoothing did most against.
void add_before_after(Answer& answer, const DenoisingStudy& study, const std::string& colormap);

// Tables and plots.
report::Table result_table(const Studies& studies);
report::Plot error_plot(const DenoisingStudy& study);

/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::q7_denoising
