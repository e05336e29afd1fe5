/// @file
/// The blocks of the section "stability". Private to the layer.
#pragma once

#include <vector>

#include "questions/stability/study.h"
#include "report/document.h"

namespace meshfolio::stability {

/// "fandisk_ns, uniform": one operator on one mesh, as the tables name it.
report::Table certificate_table(const std::vector<StabilityStudy>& studies);
report::Table unit_table(const std::vector<StabilityStudy>& studies);
report::Table growth_table(const std::vector<StabilityStudy>& studies);
report::Plot growth_plot(const StabilityStudy& study);
report::Table flow_table(const RebuiltFlow& flow);
report::Table flow_time_table(const RebuiltFlow& flow);
report::Plot flow_plot(const RebuiltFlow& flow);
std::vector<report::Check> stability_checks(const std::vector<StabilityStudy>& studies, const RebuiltFlow& flow);

/// What the numbers say. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<StabilityStudy>& studies, const RebuiltFlow& flow);

}   // namespace meshfolio::stability
