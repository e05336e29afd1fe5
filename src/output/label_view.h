#pragma once

#include <string_view>

#include "image.h"

namespace meshfolio::output {

/// Sets the name of the view ("+x", "-x" with a proper minus) in the lower left corner; small pictures stay as they are.
void label_view(render::Image& picture, std::string_view view);

}   // namespace meshfolio::output
