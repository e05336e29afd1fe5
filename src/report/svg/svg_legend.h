/// @file
/// What the colours of a figure mean, drawn in a fixed size, so that its words are as large on a phone as on paper.
#pragma once

#include <string>

#include "report/document.h"

namespace meshfolio::report {

inline constexpr double legend_width = 336;   // [pixels]

/// The quantity with its unit, the histogram of the values over their colours, numbers, and what lies beyond the colours. Words and lines
/// take the colour of the page.
std::string svg_of(const Legend& legend);

}   // namespace meshfolio::report
