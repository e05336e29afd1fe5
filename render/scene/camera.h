/// @file
/// Orthographic views, their frames, and the projections that opposite views share.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/sight.h"

namespace render {

/// A direction of sight, in unit vectors.
struct View {
    std::string_view name;
    glm::dvec3 from, up;        // from the model to the viewer; to the top of the picture
    glm::dvec3 right() const;   // up × from: to the right of the picture
    /// True if `from` and `up` are axes of the model, in either direction.
    bool is_along_axis() const;
    bool operator==(const View&) const = default;
};

inline constexpr std::array<View, 6> six_views{{
    {"+x", {1, 0, 0}, {0, 1, 0}},
    {"-x", {-1, 0, 0}, {0, 1, 0}},
    {"+y", {0, 1, 0}, {0, 0, -1}},   // y cannot be up here
    {"-y", {0, -1, 0}, {0, 0, 1}},
    {"+z", {0, 0, 1}, {0, 1, 0}},
    {"-z", {0, 0, -1}, {0, 1, 0}},
}};

/// True for the name of one of the six views.
bool is_name_of_six(std::string_view name);

/// Returns the view "hero": from 35° to the right of +z (towards +x) and 22° above, with +y up.
View three_quarter_view();

/// Returns the view named "+x", "-x" … "-z" or "hero" (three_quarter_view()) of a model with this axis up. Views along that axis have the
/// front of the model below (from above) or above (from below). @throws std::invalid_argument for another name, with the known ones
View view_named(const std::string& name, Up up = Up::y);

/// Returns the view "camera" from this place.
View view_from(const Angles& camera, Up up = Up::y);

/// Returns a vector of a model with y up, turned with the model so that another axis is up.
glm::dvec3 turned_to(Up up, const glm::dvec3& v);

/// True if the triangle's indices are in range and its corners finite. Other triangles are ignored everywhere.
bool can_be_drawn(const glm::ivec3& triangle, std::span<const glm::dvec3> positions);

struct Bounds {
    glm::dvec3 low{0}, high{0};
};
/// Returns the box of the triangles that can be drawn; the origin if there are none.
Bounds bounds_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles);

/// The middle and the scale of pictures.
struct Frame {
    glm::dvec3 centre{0};
    double pixels_per_unit = 1;
};
/// Returns the box of the drawable triangles in the picture of a view: pixels to the right (x) and up (y) from its middle; z is 0.
Bounds bounds_in_picture(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles, const View& view,
                         const Frame& frame);
/// Returns a frame for all views along the axes: the largest extent of `bounds` takes `fill` (0 to 1) of the shorter picture side. 1 pixel
/// per unit if `bounds` is a point.
Frame frame_of(const Bounds& bounds, int width, int height, double fill);
/// Returns the frame of one view: the drawable triangles are centred and take `fill` of the picture in width or in height, whichever fits.
Frame frame_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles, const View& view, int width, int height,
               double fill);

/// Orthonormal axes of a picture plane; the first nonzero component of each is positive.
struct Axes {
    glm::dvec3 across, up, depth;

    /// Returns +1 if across × up = depth, −1 if it is −depth.
    int handedness() const;
    friend bool operator==(const Axes&, const Axes&) = default;
};

/// The relation of a view to its projection.
struct Placement {
    std::size_t view;              // index
    bool mirrored_x, mirrored_y;   // the view's right is −across, its up −up
    bool from_below;               // the view sees the smallest depth
};

struct Projection {
    Axes axes;
    std::vector<Placement> placements;
};

/// Returns the projections of `views`, in the order of their first views. Opposite orthographic views share one: they see mirrored
/// pictures, one of the highest and one of the lowest triangles.
std::vector<Projection> projections_of(std::span<const View> views);

}   // namespace render
