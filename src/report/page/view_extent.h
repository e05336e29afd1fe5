/// @file
/// Which parts of a document a brief page shows (view_model.h).
#pragma once

#include <set>

#include "report/numbering.h"
#include "report/page/view_model.h"

namespace meshfolio::report {

/// Whether the page shows less than all of the section.
bool is_brief(const Section& section, Extent extent);

/// The blocks of the section that the page shows.
std::set<const Block*> blocks_shown(const Section& section, Extent extent);

/// Removes the anchors of everything that the page leaves out.
void leave_out_hidden(const Document& document, Extent extent, Numbering& numbering);

}   // namespace meshfolio::report
