/// @file
/// A surface made ready to be drawn: its vertices on the sample grid, with what shading needs of them.
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

/// A vertex in grid steps from the middle of the picture. The rounded surface is what is drawn: coverage is decided in integers.
struct GridVertex {
    std::array<std::int32_t, 3> at;   // `far_off` in all three when one is beyond `largest_near`, `undefined` when one is not finite
    std::uint32_t normal;             // packed; see pack_normal

    static constexpr std::int32_t largest_near = 1 << 23;   // 2¹⁵ pixels: twice the largest picture
    static constexpr std::int32_t undefined = std::numeric_limits<std::int32_t>::min(), far_off = undefined + 1;
};
static_assert(sizeof(GridVertex) == 16);

/// A normal in three times 10 bits, (n + 1) · 511, fine enough for light; above them two bits of `sharpness`, in thirds: how far the
/// triangles at the vertex keep normals of their own, because the surface has a crease there. 0 stands for no normal.
std::uint32_t pack_normal(const glm::vec3& n, float sharpness);
glm::vec3 unpacked_normal(std::uint32_t packed);

/// A corner of a triangle on the screen, exactly: x to the right and y down from the upper left corner of the picture, in grid steps.
struct ScreenPoint {
    std::int64_t x = 0, y = 0;
    double depth = 0;   // grid steps from the middle of the picture along the depth axis
    auto operator<=>(const ScreenPoint&) const = default;
};
/// Corners up to here are drawn exactly (2⁴⁴ pixels from the corner of the picture); triangles that reach farther are left out.
inline constexpr std::int64_t largest_coordinate = std::int64_t{1} << 52;

struct Triangle2 {
    std::array<ScreenPoint, 3> corner;
    bool operator==(const Triangle2&) const = default;
};

/// What does not depend on the view. Memory: 16 bytes a vertex, 4 more with values.
struct Scene {
    const Surface& surface;
    Frame frame;
    int width, height;
    LargeArray<GridVertex> vertices;   // along the axes of the model
    bool has_far_off = false;          // some vertex is
    LargeArray<float> map_positions;   // place in the colour map, 0 to 1 within the range; NaN: undefined; empty: no values

    Scene(const Surface& surface, const Frame& frame, const DrawOptions& options);

    std::int32_t triangle_count() const { return static_cast<std::int32_t>(surface.triangles.size()); }
    /// Of the corners; a negative index is out of range, too.
    bool has_known_corners(std::int32_t id) const {
        const glm::ivec3& t = surface.triangles[static_cast<std::size_t>(id)];
        const auto known = [&](int v) { return static_cast<std::size_t>(v) < vertices.size(); };
        return known(t.x) && known(t.y) && known(t.z);
    }
};

/// A scene as one projection sees it.
struct ProjectedScene {
    const Scene& scene;
    Axes axes;
    std::array<int, 3> component;           // of GridVertex::at that lies across, up, in depth
    LargeArray<GridVertex> turned;          // along `axes`, where those are not the model's own
    const GridVertex* vertices = nullptr;   // `turned` or those of the scene
    bool has_far_off = false;               // some vertex is

    ProjectedScene(const Scene& scene, const Axes& axes);
    ProjectedScene(ProjectedScene&&) = default;

    /// From the original coordinates; may be farther off than a GridVertex can say.
    ScreenPoint exact_corner(int vertex) const;
    Triangle2 exact_triangle(std::int32_t id) const;
};

}   // namespace render
