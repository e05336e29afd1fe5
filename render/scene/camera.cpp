#include "scene/camera.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <stdexcept>

#include "rounding.h"
#include "scene/large_array.h"

namespace render {

glm::dvec3 View::right() const { return glm::cross(up, from); }

bool View::is_along_axis() const {
    return std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}) == 1 &&
           std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}) == 1;
}

bool is_name_of_six(std::string_view name) { return std::ranges::find(six_views, name, &View::name) != six_views.end(); }

glm::dvec3 turned_to(Up up, const glm::dvec3& v) {
    return up == Up::x ? glm::dvec3(v.y, -v.x, v.z) : up == Up::z ? glm::dvec3(v.x, -v.z, v.y) : v;
}

namespace {

/// Returns the view from an azimuth and an elevation [radians] of a model with y up.
View view_at(std::string_view name, double a, double e) {
    return {name,
            {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)},
            {-std::sin(e) * std::sin(a), std::cos(e), -std::sin(e) * std::cos(a)}};
}

/// Returns the vector with components that are only rounding set to 0, so that a camera at right angles looks along an axis.
glm::dvec3 on_axes(glm::dvec3 v) {
    for (int k = 0; k < 3; ++k) v[k] = std::abs(v[k]) < 1e-15 ? 0 : std::abs(v[k]) > 1 - 1e-15 ? std::copysign(1.0, v[k]) : v[k];
    return v;
}

}   // namespace

View three_quarter_view() {
    constexpr double azimuth = 35, elevation = 22;   // degrees: from +z towards +x, and upwards
    return view_at("hero", glm::radians(azimuth), glm::radians(elevation));
}

View view_from(const Angles& camera, Up up) {
    const View upright = view_at("camera", glm::radians(camera.azimuth), glm::radians(camera.elevation));
    const double roll = glm::radians(camera.roll);
    const glm::dvec3 rolled = std::cos(roll) * upright.up - std::sin(roll) * upright.right();
    return {upright.name, on_axes(turned_to(up, upright.from)), on_axes(turned_to(up, rolled))};
}

View view_named(const std::string& name, Up up) {
    std::string known;
    for (const View& view : six_views) {
        known += std::string(view.name) + ", ";
        if (view.name != name) continue;
        const glm::dvec3 top = turned_to(up, {0, 1, 0}), front = turned_to(up, {0, 0, 1});
        const double above = glm::dot(view.from, top);
        return {view.name, view.from, above == 0 ? top : -above * front + 0.0};   // never −0
    }
    if (View hero = three_quarter_view(); name == hero.name) return {hero.name, turned_to(up, hero.from), turned_to(up, hero.up)};
    throw std::invalid_argument("unknown view '" + name + "'; known are " + known + "hero");
}

namespace {

bool is_finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool has_known_corners(const glm::ivec3& triangle, std::size_t vertices) {
    const auto is_known = [&](int v) { return v >= 0 && static_cast<std::size_t>(v) < vertices; };
    return is_known(triangle.x) && is_known(triangle.y) && is_known(triangle.z);
}

/// The state of a vertex, in one byte: unlike positions, these stay in the cache while triangles visit them in any order.
enum class Corner : std::uint8_t { not_finite, unused, drawn };

/// Returns the state of each vertex: drawn if it is a corner of a triangle that can be drawn.
std::vector<Corner> drawn_corners(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles) {
    std::vector<Corner> corners(positions.size());
    for_each_index(positions.size(), [&](std::size_t i) { corners[i] = is_finite(positions[i]) ? Corner::unused : Corner::not_finite; });
    for_each_index(triangles.size(), [&](std::size_t i) {
        const glm::ivec3& t = triangles[i];
        if (!has_known_corners(t, positions.size())) return;
        const std::array at{std::atomic_ref(corners[index(t.x)]), std::atomic_ref(corners[index(t.y)]),
                            std::atomic_ref(corners[index(t.z)])};
        std::array<Corner, 3> now;
        for (std::size_t k = 0; k < 3; ++k) now[k] = at[k].load(std::memory_order_relaxed);
        if (std::ranges::find(now, Corner::not_finite) != now.end()) return;
        for (std::size_t k = 0; k < 3; ++k)
            if (now[k] != Corner::drawn) at[k].store(Corner::drawn, std::memory_order_relaxed);
    });
    return corners;
}

/// Returns the box of place(position) over the corners that are drawn; the origin if there are none.
template <class Place>
Bounds bounds_of_corners(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles, const Place& place) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Bounds nothing{glm::dvec3(infinity), glm::dvec3(-infinity)};
    const auto joined = [](const Bounds& a, const Bounds& b) { return Bounds{glm::min(a.low, b.low), glm::max(a.high, b.high)}; };
    const std::vector<Corner> corners = drawn_corners(positions, triangles);
    const auto with_corners = [&](const auto& part, Bounds box) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
            if (corners[i] != Corner::drawn) continue;
            const glm::dvec3 p = place(positions[i]);
            box = joined(box, {p, p});
        }
        return box;
    };
    const Bounds box = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, corners.size(), 16384), nothing, with_corners, joined);
    return box.low.x <= box.high.x ? box : Bounds{};
}

/// True if the first nonzero component is negative.
bool points_backwards(const glm::dvec3& v) {
    for (int k = 0; k < 3; ++k)
        if (v[k] != 0) return v[k] < 0;
    return false;
}

glm::dvec3 forwards(const glm::dvec3& v) { return (points_backwards(v) ? -v : v) + 0.0; }   // never −0

}   // namespace

bool can_be_drawn(const glm::ivec3& t, std::span<const glm::dvec3> positions) {
    return has_known_corners(t, positions.size()) && is_finite(positions[index(t.x)]) && is_finite(positions[index(t.y)]) &&
           is_finite(positions[index(t.z)]);
}

Bounds bounds_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles) {
    return bounds_of_corners(positions, triangles, [](const glm::dvec3& p) { return p; });
}

Bounds bounds_in_picture(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles, const View& view,
                         const Frame& frame) {
    return bounds_of_corners(positions, triangles, [&](const glm::dvec3& p) {
        const glm::dvec3 pixels = (p - frame.centre) * frame.pixels_per_unit;
        return glm::dvec3(glm::dot(pixels, view.right()), glm::dot(pixels, view.up), 0);
    });
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
    const Frame along_axes = frame_of(bounds_of(positions, triangles), width, height, fill);
    const Bounds seen = bounds_in_picture(positions, triangles, view, along_axes);   // in pixels: no size of the model overflows
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
