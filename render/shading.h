/// @file
/// The colour of what a pixel sees.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <span>

#include "outline.h"
#include "scene.h"
#include "srgb.h"

namespace render {

/// The colours of a surface in linear light, opaque.
struct Palette {
    static constexpr int steps = 4096;

    LinearColor plain, undefined;
    std::vector<LinearColor> ramp;   // the colour map at steps + 1 places

    explicit Palette(const DrawOptions& options);
    const LinearColor& at(float map_position) const {
        return ramp[static_cast<std::size_t>(std::lrint(std::clamp(map_position, 0.0F, 1.0F) * steps))];
    }
};

/// Everything one view is shaded from. Ids from the number of triangles on are those of ribbons.
struct Picture {
    const Scene& scene;
    const View& view;
    const DrawOptions& options;
    const Palette& palette;
    std::vector<ScreenPoint> points;
    std::vector<Ribbon> ribbons;

    std::int32_t triangle_count() const { return static_cast<std::int32_t>(scene.surface.triangles.size()); }
    bool is_ribbon(std::int32_t id) const { return id >= triangle_count(); }
    const Ribbon& ribbon(std::int32_t id) const { return ribbons[static_cast<std::size_t>(id - triangle_count())]; }
    Triangle2 on_screen(std::int32_t id) const {
        if (is_ribbon(id)) return ribbon(id).screen;
        const glm::ivec3& t = scene.triangle(id);
        return {{points[static_cast<std::size_t>(t.x)], points[static_cast<std::size_t>(t.y)], points[static_cast<std::size_t>(t.z)]}};
    }
};

/// What shading needs of one triangle.
struct ShadedTriangle {
    struct Corner {
        glm::vec3 normal;   // right, up, towards the viewer
        float map_position;
    };

    std::int32_t id = Visible::nothing;
    bool is_back = false;
    glm::dvec2 origin{};                     // first corner, in 1/256 pixel
    glm::dvec2 to_weight1{}, to_weight2{};   // barycentric weights of the other corners by the distance from it
    glm::vec3 heights{};                     // over each edge, in pixels
    std::array<Corner, 3> corner{};

    ShadedTriangle() = default;
    ShadedTriangle(const Picture& picture, std::int32_t id);
    glm::vec3 barycentric(glm::dvec2 at) const;
};

/// Shades visible triangles. Neighbouring pixels often see the same ones, so some are kept.
class Shader {
public:
    explicit Shader(const Picture& picture) : picture_(picture) {}

    /// The colour of triangle `id` at a point of it, in 1/256 pixel.
    LinearColor color(std::int32_t id, glm::dvec2 at);

private:
    LinearColor base_color(const ShadedTriangle& t, const glm::vec3& weights) const;

    const Picture& picture_;
    std::array<ShadedTriangle, 64> kept_{};
};

/// How strongly a surface with this unit normal (right, up, towards the viewer) is lit, 0 to 1; neutral in colour.
float lit(const glm::vec3& normal);

}   // namespace render
