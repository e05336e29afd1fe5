#pragma once

#include <string_view>

#include "scene/image.h"

namespace meshfolio::output {

/// Sets the name of the view and its axes into the corner where they hide least of the surface. Pictures below 100 pixels and the view
/// from three quarters stay as they are.
void label_view(render::Image& picture, std::string_view view);

}   // namespace meshfolio::output
