/// @file
/// Small copies of pictures for inside the page.
#pragma once

#include <string>

#include "scene/image.h"

namespace meshfolio::output {

struct Preview {
    std::string jpeg;   // its bytes
    int width = 0, height = 0;
};

/// Made from the pixels alone: the picture as it is, or as read back from its PNG, gives the same bytes. Never enlarged.
Preview preview_of(const render::Image& picture, int widest, int jpeg_quality);

}   // namespace meshfolio::output
