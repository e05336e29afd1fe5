/// @file
/// The parts of the preflight.
#pragma once

#include "questions/core/section_tools.h"
#include "questions/preflight/defects.h"

namespace meshfolio::preflight {

inline constexpr report::Words words("preflight");

}   // namespace meshfolio::preflight
