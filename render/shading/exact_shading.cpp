#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "rounding.h"
#include "shading/shading_style.h"

namespace render {

namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Returns the value at barycentric coordinates `w`. Near a corner without a value it is NaN; elsewhere such corners do not count.
float interpolated(const std::array<float, 3>& values, const glm::dvec3& w) {
    const std::size_t nearest = w.y > w.x ? (w.z > w.y ? 2 : 1) : (w.z > w.x ? 2 : 0);
    if (std::isnan(values[nearest])) return values[nearest];
    double total = 0, weight = 0;
    for (int k = 0; k < 3; ++k)
        if (const float value = values[index(k)]; !std::isnan(value)) total += w[k] * double(value), weight += w[k];
    return static_cast<float>(total / weight);
}

}   // namespace

void interpolate_exactly(const ProjectedScene& projected, std::span<const Ribbon> ribbons, std::int32_t id, const ShadingStyle& style,
                         Fragments& fragments, std::size_t i) {
    const Scene& scene = projected.scene;
    const bool is_ribbon = id >= scene.triangle_count();
    const Ribbon shown =
        is_ribbon ? ribbons[index(id - scene.triangle_count())] : Ribbon{projected.exact_triangle(id), scene.surface.triangles[index(id)]};
    const auto at = [&](std::size_t k) {   // from the middle of the picture, y up
        const ScreenPoint& corner = shown.screen.corner[k];
        return glm::dvec2(static_cast<double>(corner.x - long{half_pixel} * scene.width),
                          static_cast<double>(long{half_pixel} * scene.height - corner.y));
    };
    const glm::dvec2 ab = at(1) - at(0), ac = at(2) - at(0), p = glm::dvec2(fragments.x[i], fragments.y[i]) - at(0);
    const double twice_area = cross(ab, ac);
    const double wb = std::clamp(cross(p, ac) / twice_area, 0.0, 1.0), wc = std::clamp(cross(ab, p) / twice_area, 0.0, 1.0 - wb);
    const glm::dvec3 w(1 - wb - wc, wb, wc);
    glm::vec3 normal(0);
    std::array<float, 3> values{};
    for (int k = 0; k < 3; ++k) {
        const std::size_t v = index(shown.vertex[k]);
        normal += static_cast<float>(w[k]) * unpacked_normal(scene.vertices[v].normal);
        if (style.has_values) values[index(k)] = scene.map_positions[v];
    }
    const Axes& axes = projected.axes;
    const bool faces_away = !is_ribbon && twice_area * axes.handedness() * double(style.towards_viewer) < 0;
    const float sign = faces_away ? -1.0F : 1.0F;
    fragments.normal_x[i] = sign * glm::dot(normal, glm::vec3(axes.across));
    fragments.normal_y[i] = sign * glm::dot(normal, glm::vec3(axes.up));
    fragments.normal_z[i] = sign * glm::dot(normal, glm::vec3(axes.depth));
    fragments.map_position[i] = interpolated(values, w);
    fragments.back[i] = faces_away ? 1.0F : 0.0F;
    fragments.ink[i] = 0;
    fragments.fixed_light[i] = !is_ribbon ? 0 : style.has_values ? ribbon_light : plain_ribbon_light;
}

}   // namespace render
