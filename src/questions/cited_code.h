/// @file
/// Which functions answer a question: what the report and the head of src.txt cite.
#pragma once

#include <string_view>
#include <vector>

#include "report/document.h"

namespace meshfolio {

/// The functions and classes a section cites, without lines; src/submission finds those.
/// @param id  of the section, "q1"
std::vector<report::CodeReference> cited_code(std::string_view id);

}   // namespace meshfolio
