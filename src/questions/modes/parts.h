/// @file
/// Parts of the section "modes".
#pragma once

#include "questions/modes/study.h"

namespace meshfolio::modes {

inline constexpr report::Words words("modes");

using Studies = std::vector<ModeStudy>;

/// No coefficient may be farther than this from its law, over the largest.
inline constexpr double law_tolerance = 1e-9;

inline std::string scheme_name(SmoothingScheme scheme) { return scheme == SmoothingScheme::explicit_euler ? "explicit" : "implicit"; }

report::Table damping_table(const Studies& studies);
/// |factor| of each mode against μ/μ_max for one of the schemes, measured on the laws.
report::Plot damping_plot(const ModeStudy& study, SmoothingScheme scheme);
report::Table gap_table(const Studies& studies);
report::Plot cost_plot(const ModeStudy& study);
report::Plot truth_plot(const ModeStudy& study);
report::Table crossing_table(const Studies& studies);

void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::modes
