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

/// Returns the edges with exactly one triangle, sorted by their ends. Takes linear time for closed surfaces.
std::vector<BoundaryEdge> boundary_edges(const Surface& surface);

/// One half of the quadrilateral that shows an edge on the screen.
struct Ribbon {
    Triangle2 screen;
    glm::ivec3 vertex;   // of the surface, from which each corner takes its value
};

/// Returns ribbons along the edges with triangles that are seen edge-on (within a quarter of a degree), if these are at least half of the
/// edges; else none, because the surface does not vanish. @param width  of a ribbon [pixels]
std::vector<Ribbon> edge_on_ribbons(const ProjectedScene& scene, std::span<const BoundaryEdge> edges, double width);

}   // namespace render
