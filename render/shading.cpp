#include "shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace render {

namespace {

struct Light {
    glm::vec3 direction;
    float strength;
};

/// Fixed to the camera. Soft: each reaches a little beyond its horizon. With the ambient part they add up to about 1 where all
/// of them reach, so no colour of a map is driven to white, and being neutral they shift no hue.
const std::array<Light, 3> lights{{
    {glm::normalize(glm::vec3(-0.45F, 0.62F, 0.64F)), 0.66F},   // key, upper left
    {glm::normalize(glm::vec3(0.80F, 0.10F, 0.59F)), 0.17F},    // fill, right
    {glm::normalize(glm::vec3(0.05F, -0.35F, 0.94F)), 0.18F},   // from the viewer, slightly below
}};
constexpr float ambient = 0.05F;
constexpr float wrap = 0.15F;

/// Beyond `crease_begin` (cosine) between the normals of corner and triangle the corner turns sharp, wholly so at `crease_end`.
constexpr float crease_begin = 0.94F, crease_end = 0.85F;

/// Of values only this much of the lighting shows, so that dark and light parts can still be read off the colour bar.
constexpr float light_on_values = 0.72F;

/// The back of plain surfaces is ochre; values keep their hue there and only darken.
constexpr glm::vec3 back_tint{0.86F, 0.62F, 0.40F};
constexpr float back_darkening = 0.62F;

constexpr LinearColor edge_color{0.012F, 0.012F, 0.016F, 1};
constexpr float edge_half_width = 0.45F;   // pixels on either side
constexpr float smallest_meshed = 9;       // pixels; lines of smaller triangles fade, lest they blacken the surface
/// Ribbons are a little darker than the surface, plain ones more so, to stand out on white.
constexpr float ribbon_light = 0.38F, plain_ribbon_light = 0.25F;

Rgba id_color(std::int32_t id) {
    const auto number = static_cast<std::uint32_t>(id) + 1;
    return {static_cast<std::uint8_t>(number >> 16), static_cast<std::uint8_t>(number >> 8), static_cast<std::uint8_t>(number), 255};
}

Rgba opaque(Rgba color) { return {color.r, color.g, color.b, 255}; }

/// The value at a point; where corners are undefined, the nearest corner decides whether the point is.
float interpolated(const std::array<float, 3>& t, const glm::vec3& weights) {
    int nearest = 0;
    float sum = 0, weight = 0;
    for (int k = 0; k < 3; ++k) {
        if (weights[k] > weights[nearest]) nearest = k;
        if (std::isnan(t[static_cast<std::size_t>(k)])) continue;
        sum += weights[k] * t[static_cast<std::size_t>(k)];
        weight += weights[k];
    }
    const float at_nearest = t[static_cast<std::size_t>(nearest)];
    return std::isnan(at_nearest) || weight == 0 ? at_nearest : sum / weight;
}

/// The normal of the vertex, or of the triangle where the surface has a crease.
glm::vec3 corner_normal(const glm::vec3& vertex_normal, const glm::vec3& face_normal) {
    const float sharp = std::clamp((crease_begin - glm::dot(vertex_normal, face_normal)) / (crease_begin - crease_end), 0.0F, 1.0F);
    return sharp * face_normal + (1 - sharp) * vertex_normal;
}

float light(const ShadedTriangle& t, const glm::vec3& weights) {
    const glm::vec3 n = weights.x * t.corner[0].normal + weights.y * t.corner[1].normal + weights.z * t.corner[2].normal;
    const float length = glm::length(n);
    return length > 0 ? lit(n / length) : lit({0, 0, 1});
}

float strength_of_light(const ShadedTriangle& t, const glm::vec3& weights, bool plain, bool ribbon) {
    if (ribbon) return plain ? plain_ribbon_light : ribbon_light;
    const float l = light(t, weights);
    return plain ? l : 1 - light_on_values * (1 - l);
}

/// 1 on the edges of the triangle, 0 a pixel away.
float edge_strength(const ShadedTriangle& t, const glm::vec3& weights) {
    const glm::vec3 distance = weights * t.heights;
    const float nearest = std::min({distance.x, distance.y, distance.z});
    const float smallest = std::min({t.heights.x, t.heights.y, t.heights.z});
    return std::clamp(edge_half_width + 0.5F - nearest, 0.0F, 1.0F) * std::clamp(smallest / smallest_meshed, 0.0F, 1.0F);
}

}   // namespace

float lit(const glm::vec3& normal) {
    float sum = ambient;
    for (const Light& l : lights) sum += l.strength * std::max(0.0F, (glm::dot(normal, l.direction) + wrap) / (1 + wrap));
    return std::min(sum, 1.0F);
}

Palette::Palette(const DrawOptions& options)
    : plain(linear_of(opaque(options.surface_color))), undefined(linear_of(opaque(options.undefined_color))) {
    ramp.reserve(steps + 1);
    for (int i = 0; i <= steps; ++i) ramp.push_back(linear_of(opaque(color_at(*options.range.colormap, double(i) / steps))));
}

ShadedTriangle::ShadedTriangle(const Picture& picture, std::int32_t number) : id(number) {
    const Scene& scene = picture.scene;
    const View& view = picture.view;
    const bool ribbon = picture.is_ribbon(id);
    const Triangle2 screen = picture.on_screen(id);
    const glm::ivec3 vertex = ribbon ? picture.ribbon(id).vertex : scene.triangle(id);
    const glm::dvec3 normal = ribbon ? view.from : scene.face_normal(id);
    const glm::vec3 face_normal(normal / std::max(glm::length(normal), std::numeric_limits<double>::min()));
    const glm::vec3 right(view.right()), up(view.up), from(view.from);
    is_back = glm::dot(normal, view.from) < 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(vertex[static_cast<int>(k)]);
        const glm::vec3 n = (is_back ? -1.0F : 1.0F) * (ribbon ? face_normal : corner_normal(scene.normals[v], face_normal));
        corner[k] = {{glm::dot(n, right), glm::dot(n, up), glm::dot(n, from)}, scene.map_positions.empty() ? 0 : scene.map_positions[v]};
    }
    const auto between = [&](std::size_t i, std::size_t j) {
        return glm::dvec2(screen.corner[j].x - screen.corner[i].x, screen.corner[j].y - screen.corner[i].y);
    };
    const glm::dvec2 u = between(0, 1), v = between(0, 2);
    const double area = u.x * v.y - u.y * v.x;
    origin = {screen.corner[0].x, screen.corner[0].y};
    to_weight1 = glm::dvec2(v.y, -v.x) / area;
    to_weight2 = glm::dvec2(-u.y, u.x) / area;
    heights = glm::vec3(std::abs(area) / subpixels / glm::dvec3(glm::length(v - u), glm::length(v), glm::length(u)));
}

glm::vec3 ShadedTriangle::barycentric(glm::dvec2 at) const {
    // Limits, because rounding may carry points of slivers and of huge triangles out.
    const auto w1 = static_cast<float>(std::clamp(glm::dot(to_weight1, at - origin), 0.0, 1.0));
    const auto w2 = static_cast<float>(std::clamp(glm::dot(to_weight2, at - origin), 0.0, 1.0));
    return {std::max(0.0F, 1 - w1 - w2), w1, std::min(w2, 1 - w1)};
}

LinearColor Shader::base_color(const ShadedTriangle& t, const glm::vec3& weights) const {
    if (picture_.options.face_colors_from_id) return linear_of(id_color(t.id));
    if (picture_.scene.map_positions.empty()) return picture_.palette.plain;
    const float at = interpolated({t.corner[0].map_position, t.corner[1].map_position, t.corner[2].map_position}, weights);
    return std::isnan(at) ? picture_.palette.undefined : picture_.palette.at(at);
}

LinearColor Shader::color(std::int32_t id, glm::dvec2 at) {
    ShadedTriangle& t = kept_[static_cast<std::size_t>(id) % kept_.size()];
    if (t.id != id) t = ShadedTriangle(picture_, id);
    const DrawOptions& options = picture_.options;
    const glm::vec3 weights = t.barycentric(at);
    LinearColor c = base_color(t, weights);
    if (options.face_colors_from_id) return c;
    const bool plain = picture_.scene.map_positions.empty(), ribbon = picture_.is_ribbon(id);
    if (options.shading) {
        glm::vec3 tint(strength_of_light(t, weights, plain, ribbon));
        if (t.is_back && options.backface_tint) tint *= plain ? back_tint : glm::vec3(back_darkening);
        c = {tint.r * c.r, tint.g * c.g, tint.b * c.b, c.a};
    }
    if (options.edges && !ribbon) {
        const float strength = edge_strength(t, weights);
        c = (1 - strength) * c;
        c += strength * edge_color;
    }
    return c;
}

}   // namespace render
