#pragma once

#include "submission/source_listing.h"

namespace meshfolio::run {

/// src.txt of this program, with the index of all sections of the report.
const submission::SourceListing& own_source();

}   // namespace meshfolio::run
