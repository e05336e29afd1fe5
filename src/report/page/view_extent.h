/// @file
/// What of a document is told where not all of it is (view_model.h).
#pragma once

#include <set>

#include "report/numbering.h"
#include "report/page/view_model.h"

namespace meshfolio::report {

/// Whether less than everything is told of the section.
bool is_brief(const Section& section, Extent extent);

/// The blocks of the section that are told.
std::set<const Block*> blocks_told(const Section& section, Extent extent);

/// Takes the anchors of all that is not told.
void leave_out_untold(const Document& document, Extent extent, Numbering& numbering);

}   // namespace meshfolio::report
