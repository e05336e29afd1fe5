/// @file
/// The box of a colour in a picture, and a colour bar with all its parts.
#pragma once

#include <algorithm>
#include <string>

#include "sheet/figure_sheet.h"

namespace render_tests {

using render::Image;
using render::Rgba;

inline constexpr Rgba white{255, 255, 255, 255};

struct Box {
    int x0 = 1 << 20, x1 = -1, y0 = 1 << 20, y1 = -1, count = 0;
    bool is_full(int width, int height) const { return x1 - x0 + 1 == width && y1 - y0 + 1 == height && count == width * height; }
};

inline Box box_of(const Image& image, Rgba color) {
    Box b;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y) == color) b = {std::min(b.x0, x), std::max(b.x1, x), std::min(b.y0, y), std::max(b.y1, y), b.count + 1};
    return b;
}

inline render::ColorBar long_bar() {
    return {{&render::colormap_named("viridis"), -1234.5, 6543.2}, std::string(300, 'q'), "some unit", 0.123, 0.0456, true};
}

}   // namespace render_tests
