/// @file
/// Which parts of a document each of its two volumes contains.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "report/bibliography.h"
#include "report/numbering.h"
#include "report/writers.h"

namespace meshfolio::report {

/// The blocks of the section that the volume has, one after the other.
std::span<const Block> blocks_in(const Section& section, Volume volume);

/// Whether the volume has a section for it: the report has the questions, the appendix the others and what questions leave to it.
bool has_section(const Section& section, Volume volume);

/// The appendix's section of a question, which stands in the report: "q4-further".
std::string further_id(const Section& section);

/// Ids of the figures shown, the cover included.
std::set<std::string> figures_in(const Document& document, Volume volume);

/// Marks in the numbering what the other volume contains. @param page  file of that volume; empty: no link leads there
void mark_elsewhere(const Document& document, Volume volume, const std::string& page, Numbering& numbering);

/// The works that a volume refers to.
std::set<std::string> works_cited_in(const Document& document, Volume volume, const std::vector<CitedWork>& works);

}   // namespace meshfolio::report
