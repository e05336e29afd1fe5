/// @file
/// What is done to a picture once it is drawn: the name of the view, room for a colour bar, a small copy for the page.
#pragma once

#include <string>
#include <string_view>

#include "scene/image.h"
#include "sheet/color_bar.h"

namespace meshfolio::output {

/// Sets the name of the view and its axes into the corner where they hide least of the surface. Pictures below 100 pixels and the view
/// from three quarters stay as they are.
void label_view(render::Image& picture, std::string_view view);

/// The share of the picture's height that is left to the surface.
inline constexpr double comparison_share = 0.86;

/// The picture with room below it, so that it is `height` high; with the colour bar in that room unless `bar` is null.
render::Image with_room_below(const render::Image& picture, int height, const render::ColorBar* bar);

struct Preview {
    std::string jpeg;   // its bytes
    int width = 0, height = 0;
};

/// Made from the pixels alone: the picture as it is, or as read back from its PNG, gives the same bytes. Never enlarged.
Preview preview_of(const render::Image& picture, int widest, int jpeg_quality);

}   // namespace meshfolio::output
