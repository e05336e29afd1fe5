/// @file
/// Orthographic views, the frame they share, and the projections they are drawn from.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// Looks from the named side to the centre. right = up × from.
struct View {
    std::string_view name;
    glm::dvec3 from, up;
    glm::dvec3 right() const;
    bool is_along_axis() const;
};

inline constexpr std::array<View, 6> six_views{{
    {"+x", {1, 0, 0}, {0, 1, 0}},
    {"-x", {-1, 0, 0}, {0, 1, 0}},
    {"+y", {0, 1, 0}, {0, 0, -1}},   // y cannot be up here
    {"-y", {0, -1, 0}, {0, 0, 1}},
    {"+z", {0, 0, 1}, {0, 1, 0}},
    {"-z", {0, 0, -1}, {0, 1, 0}},
}};

/// From the right front and above, as one holds a model to show it; +y is up. Its name is "hero".
View three_quarter_view();

/// One of the six, or the three-quarter view. @throws std::invalid_argument listing the names
View view_named(const std::string& name);

/// False for a triangle with an index out of range or a corner that is not finite; such triangles take part in nothing.
bool can_be_drawn(const glm::ivec3& triangle, std::span<const glm::dvec3> positions);

struct Bounds {
    glm::dvec3 low{0}, high{0};
};
/// Of the triangles that can be drawn; a point at the origin when there are none.
Bounds bounds_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles);

/// What all pictures of one figure share: the same point in the middle, the same scale.
struct Frame {
    glm::dvec3 centre{0};
    double pixels_per_unit = 1;
};
/// The largest extent of `bounds` fills `fill` of the shorter picture side, in every view along an axis.
Frame frame_of(const Bounds& bounds, int width, int height, double fill);
/// What this view sees is centred and fills `fill` of the picture, in width or in height.
Frame frame_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles, const View& view, int width, int height,
               double fill);

/// Axes of a picture plane, unit and orthogonal; the first component of each that is not 0 is positive.
struct Axes {
    glm::dvec3 across, up, depth;

    /// +1 when across × up = depth, −1 when it is the other way.
    int handedness() const;
    friend bool operator==(const Axes&, const Axes&) = default;
};

/// How a view looks at its projection.
struct Placement {
    std::size_t view;              // index
    bool mirrored_x, mirrored_y;   // its right is −across, its up −up
    bool from_below;               // sees the smallest depth
};

struct Projection {
    Axes axes;
    std::vector<Placement> placements;
};

/// The projections of `views`, in the order of their first views. Opposite orthographic views see the same triangles, one the nearest and
/// one the farthest, in mirrored pictures: both are drawn from one projection.
std::vector<Projection> projections_of(std::span<const View> views);

}   // namespace render
