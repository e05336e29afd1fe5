/// @file
/// Where the code that a report cites stands in src.txt.
#pragma once

#include <string>
#include <vector>

#include "report/document.h"
#include "submission/source_listing.h"

namespace meshfolio::submission {

/// Enters the line of every cited function and class. One that is not found keeps line 0 and becomes a warning of its section.
/// @return  those that are not found, as sentences
std::vector<std::string> cite(report::Document& document, const SourceListing& listing);

}   // namespace meshfolio::submission
