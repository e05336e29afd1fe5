/// @file
/// A surface made ready to be drawn from any side, and its corners as one view sees them.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "draw_mesh.h"
#include "rasterizer.h"

namespace render {

/// In pixels round the middle of the picture: whatever the size and place of the model, from here on numbers are tame.
struct Scene {
    const Surface& surface;
    std::vector<glm::dvec3> positions;   // not finite where the model's are not
    std::vector<glm::vec3> normals;      // unit, the mean over the triangles weighted by area; 0 where there is none
    std::vector<float> map_positions;    // place in the colour map, 0 to 1 within the range; NaN: undefined; empty: no values

    const glm::ivec3& triangle(std::int32_t id) const { return surface.triangles[static_cast<std::size_t>(id)]; }
    const glm::dvec3& position(int vertex) const { return positions[static_cast<std::size_t>(vertex)]; }
    /// Not normalised: twice the area long.
    glm::dvec3 face_normal(std::int32_t id) const;
};

Scene prepare(const Surface& surface, const Frame& frame, const ValueRange& range);

/// The corners as `view` sees them, snapped to the sample grid; those too far off or not finite lie beyond `largest_coordinate`.
std::vector<ScreenPoint> project(const Scene& scene, const View& view, int width, int height);

}   // namespace render
