/// @file
/// Thin ribbons along the boundary of an open surface, which is otherwise invisible when it is seen edge-on and covers no sample.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace render {

struct BoundaryEdge {
    int a, b;
    std::int32_t triangle;   // the only triangle of the edge
};

/// Returns the edges of exactly one drawable triangle, sorted by their ends; none if the surface is closed, counting triangles that cannot
/// be drawn, which takes linear time.
std::vector<BoundaryEdge> boundary_edges(const Surface& surface);

/// One half of the quadrilateral that shows an edge on the screen.
struct Ribbon {
    Triangle2 screen;
    glm::ivec3 vertex;   // of the surface, from which each corner takes its value
};

/// Returns two ribbons along each edge with a triangle that is seen edge-on (within a quarter of a degree), equal ribbons once. Returns
/// none if fewer than half of the edges are such, because the surface does not vanish then. @param width  of the pair [pixels]
std::vector<Ribbon> edge_on_ribbons(const ProjectedScene& scene, std::span<const BoundaryEdge> edges, double width);

}   // namespace render
