/// @file
/// Sections to what results.json keeps of them and back: blocks of a kind together, and their order.
#pragma once

#include "report/json/json_fields.h"
#include "report/json/json_reader.h"

namespace meshfolio::report {

SectionEntry entry_of(const Section& section, const DrawnFigures& drawn, bool with_timings);

/// What is known of the pictures goes into `drawn`.
/// @throws JsonProblem where the order names a block that is not there, or leaves one out
Section section_of(SectionEntry entry, DrawnFigures& drawn, const JsonPlace& place);

FigureEntry entry_of(const Figure& figure, const DrawnFigures& drawn);

}   // namespace meshfolio::report
