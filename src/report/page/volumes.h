/// @file
/// Which parts of a document each of its two volumes contains.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "report/bibliography.h"
#include "report/drawn_figure.h"
#include "report/numbering.h"
#include "report/writers.h"

namespace meshfolio::report {

/// The consecutive blocks of a section that belong to the volume.
std::span<const Block> blocks_in(const Section& section, Volume volume);

/// Does the volume show this section? The report has the questions, the appendix the others and the further blocks of questions.
bool has_section(const Section& section, Volume volume);

/// The id of a question's section in the appendix: "q4-further".
std::string further_id(const Section& section);

/// Ids of the figures shown.
std::set<std::string> figures_in(const Document& document, Volume volume);

/// Returns the figure that lends the first page its first picture: the first one of the report that shows values from three quarters; null:
/// none.
const Figure* cover_figure(const Document& document, const DrawnFigures& figures);

/// Marks in the numbering what the other volume contains. @param page  file of that volume; empty: no link leads there
void mark_elsewhere(const Document& document, Volume volume, const std::string& page, Numbering& numbering);

std::set<std::string> works_cited_in(const Document& document, Volume volume, const std::vector<CitedWork>& works);

}   // namespace meshfolio::report
