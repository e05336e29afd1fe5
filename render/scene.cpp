#include "scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace render {

namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

std::vector<glm::dvec3> in_pixels(std::span<const glm::dvec3> positions, const Frame& frame) {
    std::vector<glm::dvec3> result(positions.size());
    std::transform(positions.begin(), positions.end(), result.begin(),
                   [&](const glm::dvec3& p) { return (p - frame.centre) * frame.pixels_per_unit; });
    return result;
}

std::vector<glm::vec3> vertex_normals(const Scene& scene) {
    std::vector<glm::dvec3> sum(scene.positions.size(), glm::dvec3(0));
    const auto count = static_cast<std::int32_t>(scene.surface.triangles.size());
    for (std::int32_t id = 0; id < count; ++id) {
        const glm::ivec3& t = scene.triangle(id);
        if (!can_be_drawn(t, scene.positions)) continue;
        const glm::dvec3 n = scene.face_normal(id);
        for (int k = 0; k < 3; ++k) sum[index(t[k])] += n;
    }
    std::vector<glm::vec3> normals(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double length = glm::length(sum[i]);
        if (length > 0 && std::isfinite(length)) normals[i] = glm::vec3(sum[i] / length);
    }
    return normals;
}

/// Where `value` lies between the ends of the range. Halves and the limit keep huge and infinite values from becoming NaN.
float map_position(double value, const ValueRange& range) {
    constexpr double limit = 1e6;   // ranges beyond the ends, where everything has the colour of the end
    const double width = 0.5 * range.high - 0.5 * range.low, beyond = 0.5 * value - 0.5 * range.low;
    if (std::isnan(value)) return std::numeric_limits<float>::quiet_NaN();
    if (width == 0) return value < range.low ? 0.0F : value > range.low ? 1.0F : 0.5F;
    return static_cast<float>(std::clamp(beyond / width, -limit, limit));
}

std::int64_t snapped(double pixels) {
    const double fixed = pixels * subpixels;
    return std::abs(fixed) < static_cast<double>(largest_coordinate) ? std::llrint(fixed) : 2 * largest_coordinate;
}

}   // namespace

glm::dvec3 Scene::face_normal(std::int32_t id) const {
    const glm::ivec3& t = triangle(id);
    return glm::cross(position(t[1]) - position(t[0]), position(t[2]) - position(t[0]));
}

Scene prepare(const Surface& surface, const Frame& frame, const ValueRange& range) {
    Scene scene{surface, in_pixels(surface.positions, frame), {}, {}};
    scene.normals = vertex_normals(scene);
    for (const double value : surface.values) scene.map_positions.push_back(map_position(value, range));
    return scene;
}

std::vector<ScreenPoint> project(const Scene& scene, const View& view, int width, int height) {
    constexpr double farthest = 1e30;   // keeps depths finite in float
    const glm::dvec3 right = view.right();
    const std::int64_t x_middle = width * subpixels / 2, y_middle = height * subpixels / 2;
    std::vector<ScreenPoint> points(scene.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3& p = scene.positions[i];
        points[i] = {x_middle + snapped(glm::dot(p, right)), y_middle - snapped(glm::dot(p, view.up)),
                     static_cast<float>(std::clamp(glm::dot(p, view.from), -farthest, farthest))};
    }
    return points;
}

}   // namespace render
