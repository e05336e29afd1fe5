#include "scene/camera.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <stdexcept>

#include "rounding.h"

namespace render {

glm::dvec3 View::right() const { return glm::cross(up, from); }

bool View::is_along_axis() const {
    return std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}) == 1 &&
           std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}) == 1;
}

View three_quarter_view() {
    constexpr double azimuth = 35, elevation = 22;   // degrees: from +z towards +x, and upwards
    const double a = glm::radians(azimuth), e = glm::radians(elevation);
    return {"hero",
            {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)},
            {-std::sin(e) * std::sin(a), std::cos(e), -std::sin(e) * std::cos(a)}};
}

View view_named(const std::string& name) {
    std::string known;
    for (const View& view : six_views) {
        if (view.name == name) return view;
        known += std::string(view.name) + ", ";
    }
    if (const View hero = three_quarter_view(); name == hero.name) return hero;
    throw std::invalid_argument("unknown view '" + name + "'; known are " + known + "hero");
}

namespace {

bool is_finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}   // namespace

bool can_be_drawn(const glm::ivec3& triangle, std::span<const glm::dvec3> positions) {
    for (int k = 0; k < 3; ++k) {
        if (triangle[k] < 0 || static_cast<std::size_t>(triangle[k]) >= positions.size()) return false;
        if (!is_finite(positions[static_cast<std::size_t>(triangle[k])])) return false;
    }
    return true;
}

namespace {

/// Boxes that hold nothing are the other way round: joining them changes nothing.
constexpr double infinity = std::numeric_limits<double>::infinity();
const Bounds nothing{glm::dvec3(infinity), glm::dvec3(-infinity)};

Bounds joined(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

bool points_backwards(const glm::dvec3& v) {
    for (int k = 0; k < 3; ++k)
        if (v[k] != 0) return v[k] < 0;
    return false;
}

/// Adding 0 turns −0 into 0.
glm::dvec3 forwards(const glm::dvec3& v) { return (points_backwards(v) ? -v : v) + 0.0; }

}   // namespace

Bounds bounds_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles) {
    const auto with_triangles = [&](const auto& part, Bounds box) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
            if (!can_be_drawn(triangles[i], positions)) continue;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3& p = positions[index(triangles[i][k])];
                box = joined(box, {p, p});
            }
        }
        return box;
    };
    const Bounds box = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, triangles.size(), 16384), nothing, with_triangles, joined);
    return box.low.x <= box.high.x ? box : Bounds{};
}

Frame frame_of(const Bounds& bounds, int width, int height, double fill) {
    // Halves, so that a box from −1e308 to 1e308 does not overflow.
    const glm::dvec3 half = 0.5 * bounds.high - 0.5 * bounds.low;
    const double half_extent = std::max({half.x, half.y, half.z});
    const double half_side = 0.5 * fill * std::min(width, height);
    const double scale = half_extent > 0 ? half_side / half_extent : 1;
    return {0.5 * bounds.low + 0.5 * bounds.high, std::min(scale, std::numeric_limits<double>::max())};
}

Frame frame_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles, const View& view, int width, int height,
               double fill) {
    const Bounds box = bounds_of(positions, triangles);
    const Frame along_axes = frame_of(box, width, height, fill);
    // In pixels of that frame, so that no size of the model overflows.
    Bounds seen = nothing;
    const auto on_screen = [&](const glm::dvec3& p) {
        const glm::dvec3 pixels = (p - along_axes.centre) * along_axes.pixels_per_unit;
        return glm::dvec3(glm::dot(pixels, view.right()), glm::dot(pixels, view.up), 0);
    };
    for (const glm::ivec3& t : triangles) {
        if (!can_be_drawn(t, positions)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p = on_screen(positions[static_cast<std::size_t>(t[k])]);
            seen = joined(seen, {p, p});
        }
    }
    const glm::dvec3 extent = seen.high - seen.low, middle = 0.5 * (seen.low + seen.high);
    if (!(extent.x >= 0) || std::max(extent.x, extent.y) == 0) return along_axes;
    const double scale = fill * std::min(width / extent.x, height / extent.y);
    const glm::dvec3 offset = middle.x * view.right() + middle.y * view.up;
    return {along_axes.centre + offset / along_axes.pixels_per_unit, scale * along_axes.pixels_per_unit};
}

int Axes::handedness() const { return glm::dot(glm::cross(across, up), depth) > 0 ? 1 : -1; }

std::vector<Projection> projections_of(std::span<const View> views) {
    std::vector<Projection> projections;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec3 right = views[i].right(), up = views[i].up, from = views[i].from;
        const Axes axes{forwards(right), forwards(up), forwards(from)};
        auto found = std::find_if(projections.begin(), projections.end(), [&](const Projection& p) { return p.axes == axes; });
        if (found == projections.end()) found = projections.insert(found, {axes, {}});
        found->placements.push_back({i, points_backwards(right), points_backwards(up), points_backwards(from)});
    }
    return projections;
}

}   // namespace render
