/// @file
/// Measures of a colour map: whether equal steps of a value look equal.
#pragma once

#include <string>
#include <vector>

#include "color/colormap.h"

namespace render {

/// Returns why a map is not perceptually uniform, such as "its lightness goes up and down"; "" if it is. It is uniform if the largest of 16
/// equal steps looks at most 3 times as large as the smallest (CIE94), and if the lightness of a sequential map, or of each side of a
/// diverging map, only rises or only falls. A cyclic map ends with its first colour.
std::string unevenness_of(const Colormap& map);

/// Returns the kind of a map with these stops: cyclic if the first and the last are equal; diverging if the middle is nearly grey and the
/// lightest or the darkest colour of a map whose sides only rise or only fall in lightness; else sequential.
std::string kind_of(const std::vector<Rgba>& stops);

}   // namespace render
