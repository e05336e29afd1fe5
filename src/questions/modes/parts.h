/// @file
/// Parts of the section "modes".
#pragma once

#include <string>
#include <vector>

#include "questions/modes/study.h"
#include "report/document.h"

namespace meshfolio::modes {

report::Table damping_table(const std::vector<ModeStudy>& studies);
/// |factor| of each mode against μ/μ_max for one of the schemes, measured on the laws.
report::Plot damping_plot(const ModeStudy& study, SmoothingScheme scheme);
report::Table gap_table(const std::vector<ModeStudy>& studies);
report::Table cost_table(const ModeStudy& study);
report::Plot cost_plot(const ModeStudy& study);
report::Plot truth_plot(const ModeStudy& study);
report::Table crossing_table(const std::vector<ModeStudy>& studies);
std::vector<report::Check> mode_checks(const std::vector<ModeStudy>& studies);

/// Is the gap far enough above the rounding of coordinates to be compared with its prediction?
bool seen(const ModeStudy& study, const SchemeGap& gap);

void add_discussion(report::Section& section, const std::vector<ModeStudy>& studies);

}   // namespace meshfolio::modes
