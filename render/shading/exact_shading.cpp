#include "raster/exact_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace render {

namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Where corners are undefined, the nearest corner decides whether the point is.
float interpolated(const std::array<float, 3>& t, const glm::dvec3& w) {
    const std::size_t nearest = w.y > w.x ? (w.z > w.y ? 2 : 1) : (w.z > w.x ? 2 : 0);
    if (std::isnan(t[nearest])) return t[nearest];
    double total = 0, weight = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (!std::isnan(t[k])) total += w[static_cast<int>(k)] * double(t[k]), weight += w[static_cast<int>(k)];
    return static_cast<float>(total / weight);
}

}   // namespace

ExactTriangle::ExactTriangle(const ProjectedScene& projected, std::span<const Ribbon> ribbons, std::int32_t id)
    : scene_(projected.scene), axes_(projected.axes), is_ribbon_(id >= scene_.triangle_count()) {
    if (is_ribbon_) {
        const Ribbon& ribbon = ribbons[static_cast<std::size_t>(id - scene_.triangle_count())];
        screen_ = ribbon.screen, vertex_ = ribbon.vertex;
    } else {
        screen_ = projected.exact_triangle(id), vertex_ = scene_.surface.triangles[static_cast<std::size_t>(id)];
    }
}

void ExactTriangle::interpolate(const ShadingStyle& style, Fragments& fragments, std::size_t i) const {
    const glm::dvec3 w = barycentric(fragments, i);
    glm::vec3 normal(0);
    std::array<float, 3> t{};
    for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(vertex_[k]);
        normal += static_cast<float>(w[k]) * unpacked_normal(scene_.vertices[v].normal);
        if (style.has_values) t[static_cast<std::size_t>(k)] = scene_.map_positions[v];
    }
    const glm::vec3 along(glm::dot(normal, glm::vec3(axes_.across)), glm::dot(normal, glm::vec3(axes_.up)),
                          glm::dot(normal, glm::vec3(axes_.depth)));
    const bool faces_away = !is_ribbon_ && area() * axes_.handedness() * double(style.towards_viewer) < 0;
    const float sign = faces_away ? -1.0F : 1.0F;
    fragments.normal_x[i] = sign * along.x, fragments.normal_y[i] = sign * along.y, fragments.normal_z[i] = sign * along.z;
    fragments.map_position[i] = interpolated(t, w);
    fragments.back[i] = faces_away ? 1.0F : 0.0F;
    fragments.ink[i] = 0;
    fragments.fixed_light[i] = !is_ribbon_ ? 0 : style.has_values ? ribbon_light : plain_ribbon_light;
}

glm::dvec2 ExactTriangle::at(std::size_t k) const {
    constexpr long half = subpixels / 2;
    return {static_cast<double>(screen_.corner[k].x - half * scene_.width),
            static_cast<double>(half * scene_.height - screen_.corner[k].y)};
}

double ExactTriangle::area() const { return cross(at(1) - at(0), at(2) - at(0)); }

glm::dvec3 ExactTriangle::barycentric(const Fragments& fragments, std::size_t i) const {
    const glm::dvec2 p = glm::dvec2(fragments.x[i], fragments.y[i]) - at(0), ab = at(1) - at(0), ac = at(2) - at(0);
    const double wb = std::clamp(cross(p, ac) / area(), 0.0, 1.0), wc = std::clamp(cross(ab, p) / area(), 0.0, 1.0 - wb);
    return {1 - wb - wc, wb, wc};
}

}   // namespace render
