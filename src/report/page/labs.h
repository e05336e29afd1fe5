/// @file
/// Meshes of the live laboratory inside a page: as data, taken up by templates/models.js when a reader asks for it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

/// Those that a page of ours carries, to be put into another; what is no such data is left out.
std::vector<Lab> labs_in(std::string_view page);

}   // namespace meshfolio::report
