/// @file
/// Parts of one report, made apart (`report --part DIR --only q1,q4`), as the report they are parts of.
#pragma once

#include <vector>

#include "report/writers.h"
#include "run/earlier_report.h"

namespace meshfolio::run {

struct JoinedReport {
    report::Document document;
    report::DrawnFigures figures;
    std::vector<report::Lab> labs;
    std::size_t cover = 0;   // the part that has the picture of the first page
};

/// Each section from the first part that has it; of the covers, the one that a run of all would have chosen.
/// @param parts  at least one; their figures are moved from
/// @throws InputError naming two parts, and what they do not have in common: inputs, settings, program, or what both say of one section
JoinedReport joined(std::vector<EarlierReport>& parts);

}   // namespace meshfolio::run
