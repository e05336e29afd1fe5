/// @file
/// Parts of the section "modes".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "questions/mode_study.h"
#include "report/document.h"

namespace meshfolio {

report::Table damping_table(const std::vector<ModeStudy>& studies);
/// |factor| of each mode against μ/μ_max for one of the schemes, measured on the laws.
report::Plot damping_plot(const ModeStudy& study, SmoothingScheme scheme);
report::Table gap_table(const std::vector<ModeStudy>& studies);
report::Table cost_table(const ModeStudy& study);
report::Plot cost_plot(const ModeStudy& study);
report::Plot truth_plot(const ModeStudy& study);
report::Table crossing_table(const std::vector<ModeStudy>& studies);
std::vector<report::Check> mode_checks(const std::vector<ModeStudy>& studies);

/// A way to smooth implicitly that is compared with the explicit one.
struct ImplicitChoice {
    std::string name;   // "implicit, 3 steps"
    int which = 0;      // of SmoothingTarget::implicit_ways; −1: the one as true as the explicit way

    const SmoothingWay& of(const SmoothingTarget& target) const {
        return which < 0 ? target.matched : target.implicit_ways[static_cast<std::size_t>(which)];
    }
};
std::vector<ImplicitChoice> implicit_choices();

/// Index in the study's curve from which on the choice costs less than the explicit way, at every target to the end; empty: none.
std::optional<std::size_t> crossing_of(const ModeStudy& study, const ImplicitChoice& choice);

void add_mode_discussion(report::Section& section, const std::vector<ModeStudy>& studies);

}   // namespace meshfolio
