/// @file
/// Divides a document into its two volumes.
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

/// Returns the blocks of a section in a volume. A question has its first `appendix_from` blocks (−1: all) in the report, the rest in the
/// appendix; other sections have all in the appendix.
std::span<const Block> blocks_in(const Section& section, Volume volume);

/// True if the volume shows the section: the report has the questions, the appendix all others and questions with blocks for it.
bool has_section(const Section& section, Volume volume);

/// Returns the id of a question's section in the appendix: "q4-further".
std::string further_id(const Section& section);

/// Returns the ids of the figures of meshes in the volume, drawn or not.
std::set<std::string> figures_in(const Document& document, Volume volume);

/// Returns the figure for the cover: the first drawn one of the report with values and a picture from three quarters; null if there is
/// none.
const Figure* cover_figure(const Document& document, const DrawnFigures& figures);

/// Marks in `numbering` all ids that belong to the volume other than `volume`.
/// @param page  file of the volume other than `volume`; empty: no links
void mark_elsewhere(const Document& document, Volume volume, const std::string& page, Numbering& numbering);

/// Returns the ids of the works that answers, paragraphs or lists of the volume cite.
std::set<std::string> works_cited_in(const Document& document, Volume volume, const std::vector<CitedWork>& works);

}   // namespace meshfolio::report
