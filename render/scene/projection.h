/// @file
/// How views share their work. Opposite orthographic views see the same triangles, one the nearest and one the farthest, in mirrored
/// pictures: both are drawn from one projection.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/camera.h"

namespace render {

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

/// The projections of `views`, in the order of their first views.
std::vector<Projection> projections_of(std::span<const View> views);

}   // namespace render
