#include "shading/marks.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

#include "sheet/strokes.h"

namespace render {

namespace {

constexpr Rgba mark_color{0, 0, 0, 255}, mark_rim{255, 255, 255, 255};   // black: no colour map has it

/// Where the vertex lies in the picture, in pixels, and its height towards the viewer.
struct Place {
    glm::dvec2 at;
    double height;
};

Place place_of(const ScreenPoint& corner, const ViewPicture& picture, const Image& image) {
    const Placement& placement = picture.placement();
    const double x = static_cast<double>(corner.x) / subpixels, y = static_cast<double>(corner.y) / subpixels;
    return {{placement.mirrored_x ? image.width - x : x, placement.mirrored_y ? image.height - y : y},
            (placement.from_below ? -corner.depth : corner.depth) / subpixels};
}

/// Nothing stands over the vertex: it is no lower, up to a pixel, than the lowest surface seen round it.
bool is_seen(const Place& place, const HeightField& heights) {
    const int x = static_cast<int>(std::floor(place.at.x)), y = static_cast<int>(std::floor(place.at.y));
    if (!(place.at.x >= 0 && place.at.y >= 0) || x >= heights.width() || y >= heights.height()) return false;
    float lowest = std::numeric_limits<float>::infinity();
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
            if (const float height = heights.at(u, v); height > HeightField::nothing) lowest = std::min(lowest, height);
    return place.height >= double(lowest) - 1;
}

}   // namespace

void draw_marks(const ProjectedScene& projected, std::span<const int> vertices, ViewPicture& picture) {
    Image& image = picture.image();
    const double radius = std::max(5.0, std::min(image.width, image.height) / 36.0), width = std::max(1.5, radius / 3);
    for (const int v : vertices) {
        if (v < 0 || static_cast<std::size_t>(v) >= projected.scene.vertices.size()) continue;
        if (projected.scene.vertices[static_cast<std::size_t>(v)].at[0] <= GridVertex::far_off) continue;
        const Place place = place_of(projected.exact_corner(v), picture, image);
        if (!is_seen(place, picture.heights())) continue;
        draw_ring(image, place.at, radius, 2.2 * width, mark_rim);
        draw_ring(image, place.at, radius, width, mark_color);
    }
}

}   // namespace render
