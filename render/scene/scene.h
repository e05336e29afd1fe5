/// @file
/// A surface prepared for drawing: vertices on the sample grid, with their normals and places in the colour map.
#pragma once

#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include "draw_mesh.h"
#include "raster/sample_grid.h"
#include "scene/camera.h"
#include "scene/large_array.h"

namespace render {

/// A vertex in grid steps from the middle of the picture. Coverage is decided in integers, for the rounded surface.
struct GridVertex {
    std::array<std::int32_t, 3> at;   // all `far_off` if one is beyond `largest_near`, all `undefined` if one is not finite
    std::uint32_t normal;             // see pack_normal

    static constexpr std::int32_t largest_near = 1 << 23;   // 2¹⁵ pixels: twice the largest picture
    static constexpr std::int32_t undefined = std::numeric_limits<std::int32_t>::min(), far_off = undefined + 1;
};
static_assert(sizeof(GridVertex) == 16);

/// Packs a normal of any length into three times 10 bits, (n + 1) · 511, and above them the sharpness (0 to 1) in thirds: the share of
/// their own normals that triangles at a crease keep. Returns 0 for a normal of length 0.
std::uint32_t pack_normal(const glm::vec3& n, float sharpness);
/// Returns the normal that pack_normal() packed, of length about 1; (0, 0, 0) for 0.
glm::vec3 unpacked_normal(std::uint32_t packed);

/// The exact place of a corner on the screen, in grid steps.
struct ScreenPoint {
    std::int64_t x = 0, y = 0;   // to the right and down from the upper left corner of the picture
    double depth = 0;            // along the depth axis from the middle of the picture
    auto operator<=>(const ScreenPoint&) const = default;
};
/// The largest |x| and |y| of triangles that are drawn (2⁴⁴ pixels).
inline constexpr std::int64_t largest_coordinate = std::int64_t{1} << 52;

struct Triangle2 {
    std::array<ScreenPoint, 3> corner;
    bool operator==(const Triangle2&) const = default;
};

/// The part of a scene that all views share. Memory: 16 bytes a vertex, 4 more with values.
struct Scene {
    const Surface& surface;
    Frame frame;
    int width, height;
    LargeArray<GridVertex> vertices;   // along the axes of the model
    bool has_far_off = false;          // some vertex is far off
    LargeArray<float> map_positions;   // places in the colour map, 0 to 1 within the range; NaN: undefined; empty: no values

    Scene(const Surface& surface, const Frame& frame, const DrawOptions& options);

    std::int32_t triangle_count() const { return static_cast<std::int32_t>(surface.triangles.size()); }
    /// True if the triangle's indices are in range.
    bool has_known_corners(std::int32_t id) const {
        const glm::ivec3& t = surface.triangles[static_cast<std::size_t>(id)];
        const auto known = [&](int v) { return static_cast<std::size_t>(v) < vertices.size(); };   // not if negative
        return known(t.x) && known(t.y) && known(t.z);
    }
};

/// A scene in one projection.
struct ProjectedScene {
    const Scene& scene;
    Axes axes;
    std::array<int, 3> component;           // components of GridVertex::at across, up and in depth
    LargeArray<GridVertex> turned;          // vertices along `axes`, unless those are the model's own
    const GridVertex* vertices = nullptr;   // `turned` or those of the scene
    bool has_far_off = false;               // some vertex is far off

    ProjectedScene(const Scene& scene, const Axes& axes);
    ProjectedScene(ProjectedScene&&) = default;

    /// Returns the place of a vertex on the screen from its original coordinates; x and y beyond `largest_coordinate` if it lies farther.
    ScreenPoint exact_corner(int vertex) const;
    /// Returns exact_corner() of the three corners of triangle `id`.
    Triangle2 exact_triangle(std::int32_t id) const;
};

}   // namespace render
