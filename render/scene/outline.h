/// @file
/// What keeps an open surface visible when it is seen edge-on and covers no sample: thin ribbons along its boundary.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace render {

struct BoundaryEdge {
    int a, b;
    std::int32_t triangle;   // the only one beside it
};

/// The edges with one triangle, in the order of their triangles. Takes linear time on closed surfaces.
std::vector<BoundaryEdge> boundary_edges(const Surface& surface);

/// Half of the quadrilateral that stands for an edge on the screen.
struct Ribbon {
    Triangle2 screen;
    glm::ivec3 vertex;   // of the surface, whose value each corner has
};

/// Ribbons along those edges whose triangle is seen edge-on (within a quarter of a degree), if that are at least half of all: the
/// surface as a whole would vanish. @param width  pixels
std::vector<Ribbon> edge_on_ribbons(const ProjectedScene& scene, std::span<const BoundaryEdge> edges, double width);

}   // namespace render
