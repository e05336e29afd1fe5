/// @file
/// What pictures of a comparison have more than others: room below the surface, where the difference has its colour bar.
#pragma once

#include "scene/image.h"
#include "sheet/color_bar.h"

namespace meshfolio::output {

/// The share of the picture's height that is left to the surface.
inline constexpr double comparison_share = 0.86;

/// The picture with room below it, so that it is `height` high; with the colour bar in that room unless `bar` is null.
render::Image with_room_below(const render::Image& picture, int height, const render::ColorBar* bar);

}   // namespace meshfolio::output
