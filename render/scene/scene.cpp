#include "scene/scene.h"

#include <tbb/parallel_for.h>

#include <hwy/cache_control.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "rounding.h"

namespace render {

namespace {

glm::dvec3 in_pixels(const glm::dvec3& position, const Frame& frame) { return (position - frame.centre) * frame.pixels_per_unit; }

/// Returns GridVertex::at.
std::array<std::int32_t, 3> snapped(const glm::dvec3& pixels) {
    const glm::dvec3 steps = double(subpixels) * pixels, size = glm::abs(steps);
    const double largest = std::max(size.x, std::max(size.y, size.z));
    if (!std::isfinite(size.x + size.y + size.z))   // a maximum may miss NaN
        return {GridVertex::undefined, GridVertex::undefined, GridVertex::undefined};
    if (largest > GridVertex::largest_near) return {GridVertex::far_off, GridVertex::far_off, GridVertex::far_off};
    return {static_cast<std::int32_t>(std::lrint(steps.x)), static_cast<std::int32_t>(std::lrint(steps.y)),
            static_cast<std::int32_t>(std::lrint(steps.z))};
}

float map_position(double value, const ValueRange& range) {
    constexpr double limit = 1e6;   // far beyond the ends of the map
    if (std::isnan(value)) return std::numeric_limits<float>::quiet_NaN();
    if (0.5 * range.high - 0.5 * range.low == 0) return value < range.low ? 0.0F : value > range.low ? 1.0F : 0.5F;
    return static_cast<float>(std::clamp(range.position(value), -limit, limit));
}

/// Returns the normal of a triangle, as long as twice its area unless float would overflow; 0 if a corner is not finite.
glm::vec3 face_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double longest = 1e17;   // its square is finite in float
    const glm::dvec3 n = glm::cross(b - a, c - a), size = glm::abs(n);
    const double largest = std::max(size.x, std::max(size.y, size.z));
    if (!std::isfinite(size.x + size.y + size.z)) return glm::vec3(0);
    return largest > longest ? glm::vec3(n * (longest / largest)) : glm::vec3(n);
}

/// A vertex while its normal is computed, on one cache line, because triangles visit vertices in any order.
struct alignas(64) NormalParts {
    glm::dvec3 at;                   // in pixels
    std::array<glm::vec4, 2> sums;   // of normals times areas, and of areas, over each half of the triangles
};

/// Returns the share of their own normals that triangles at a vertex keep: 0 where they lie nearly in a plane, 1 at a crease.
/// @param length_of_mean  length of their mean normal: 1 in a plane, cos 45° on the edge of a cube
float sharpness_of(float length_of_mean) {
    constexpr float crease_begin = 0.914F, crease_end = 0.848F;   // cosines of 24° and 32°
    return std::clamp((crease_begin - length_of_mean) / (crease_begin - crease_end), 0.0F, 1.0F);
}

/// Sets the normal of each vertex: the mean over its triangles, weighted by area. Each half of the triangles has its own sums, added in a
/// fixed order, so that the result does not depend on the number of threads. Prefetching hides the latency of memory.
void set_normals(Scene& scene) {
    static constexpr std::size_t ahead = 32;
    const auto& triangles = scene.surface.triangles;
    LargeArray<NormalParts> parts(scene.vertices.size());
    for_each_index(parts.size(), [&](std::size_t i) {
        parts[i] = {in_pixels(scene.surface.positions[i], scene.frame), {glm::vec4(0), glm::vec4(0)}};
    });
    tbb::parallel_for(std::size_t{0}, std::size_t{2}, [&](std::size_t half) {
        for (std::size_t i = half * triangles.size() / 2; i < (half + 1) * triangles.size() / 2; ++i) {
            if (!scene.has_known_corners(static_cast<std::int32_t>(i))) continue;
            const glm::ivec3 &t = triangles[i], &next = triangles[std::min(i + ahead, triangles.size() - 1)];
            for (int k = 0; k < 3; ++k) hwy::Prefetch(parts.data() + next[k]);
            const glm::vec3 n = face_normal(parts[index(t.x)].at, parts[index(t.y)].at, parts[index(t.z)].at);
            const glm::vec4 part(n, glm::length(n));
            for (int k = 0; k < 3; ++k) parts[index(t[k])].sums[half] += part;
        }
    });
    for_each_index(parts.size(), [&](std::size_t i) {
        hwy::Prefetch(parts.data() + std::min(i + ahead, parts.size() - 1));
        const glm::vec4 sum = parts[i].sums[0] + parts[i].sums[1];
        scene.vertices[i].normal = pack_normal(glm::vec3(sum), sharpness_of(glm::length(glm::vec3(sum)) / sum.w));
    });
}

/// Returns the number of the model's axis that `axis` is; −1 for another direction.
int model_axis(const glm::dvec3& axis) {
    for (int k = 0; k < 3; ++k)
        if (axis[k] == 1) return k;
    return -1;
}

bool any_far_off(const LargeArray<GridVertex>& vertices) {
    std::atomic<bool> any = false;
    for_each_index(vertices.size(), [&](std::size_t i) {
        if (vertices[i].at[0] == GridVertex::far_off) any = true;
    });
    return any;
}

/// Returns grid steps; beyond `largest_coordinate` for all that lies farther.
std::int64_t snapped_far(double pixels) {
    const double steps = pixels * subpixels;
    return std::abs(steps) < static_cast<double>(largest_coordinate) ? std::llrint(steps) : 2 * largest_coordinate;
}

}   // namespace

std::uint32_t pack_normal(const glm::vec3& n, float sharpness) {
    const glm::dvec3 wide(n);
    const double length = glm::length(wide);
    if (!(length > 0)) return 0;
    const auto bits = [&](double component) { return static_cast<std::uint32_t>(std::lrint((component / length + 1) * 511)); };
    return bits(wide.x) | bits(wide.y) << 10 | bits(wide.z) << 20 | static_cast<std::uint32_t>(std::lrint(3 * sharpness)) << 30;
}

glm::vec3 unpacked_normal(std::uint32_t packed) {
    if (packed == 0) return glm::vec3(0);
    const auto component = [&](int shift) { return static_cast<float>(packed >> shift & 1023) / 511 - 1; };
    return {component(0), component(10), component(20)};
}

Scene::Scene(const Surface& drawn, const Frame& on, const DrawOptions& options)
    : surface(drawn), frame(on), width(options.width), height(options.height), vertices(drawn.positions.size()) {
    for_each_index(vertices.size(), [&](std::size_t i) { vertices[i] = {snapped(in_pixels(surface.positions[i], frame)), 0}; });
    has_far_off = any_far_off(vertices);
    if (options.shading) set_normals(*this);
    map_positions.resize(surface.values.size());
    for_each_index(map_positions.size(), [&](std::size_t i) { map_positions[i] = map_position(surface.values[i], options.range); });
}

ProjectedScene::ProjectedScene(const Scene& seen, const Axes& along)
    : scene(seen), axes(along), component{model_axis(axes.across), model_axis(axes.up), model_axis(axes.depth)} {
    vertices = scene.vertices.data();
    has_far_off = scene.has_far_off;
    if (component[0] >= 0 && component[1] >= 0 && component[2] >= 0) return;
    component = {0, 1, 2};
    turned.resize(scene.vertices.size());
    const auto along_axes = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(v, axes.across), glm::dot(v, axes.up), glm::dot(v, axes.depth));
    };
    for_each_index(turned.size(), [&](std::size_t i) {
        const std::uint32_t normal = scene.vertices[i].normal;
        turned[i] = {snapped(along_axes(in_pixels(scene.surface.positions[i], scene.frame))),
                     pack_normal(glm::vec3(along_axes(unpacked_normal(normal))), static_cast<float>(normal >> 30) / 3)};
    });
    vertices = turned.data();
    has_far_off = any_far_off(turned);
}

ScreenPoint ProjectedScene::exact_corner(int vertex) const {
    constexpr double farthest = 1e30;   // keeps depths finite in float
    const glm::dvec3 p = in_pixels(scene.surface.positions[index(vertex)], scene.frame);
    return {long{half_pixel} * scene.width + snapped_far(glm::dot(p, axes.across)),
            long{half_pixel} * scene.height - snapped_far(glm::dot(p, axes.up)),
            std::clamp(glm::dot(p, axes.depth) * subpixels, -farthest, farthest)};
}

Triangle2 ProjectedScene::exact_triangle(std::int32_t id) const {
    const glm::ivec3& t = scene.surface.triangles[index(id)];
    return {{exact_corner(t.x), exact_corner(t.y), exact_corner(t.z)}};
}

}   // namespace render
