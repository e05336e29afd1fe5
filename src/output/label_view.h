#pragma once

#include <string_view>

#include "image.h"

namespace meshfolio::output {

/// Sets the name of the view and its axes in the lower left corner; pictures below 100 pixels stay as they are.
void label_view(render::Image& picture, std::string_view view);

}   // namespace meshfolio::output
