#include "camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace render {

glm::dvec3 View::right() const { return glm::cross(up, from); }

const View& view_named(const std::string& name) {
    std::string known;
    for (const View& view : six_views) {
        if (view.name == name) return view;
        known += (known.empty() ? "" : ", ") + std::string(view.name);
    }
    throw std::invalid_argument("unknown view '" + name + "'; known are " + known);
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

Bounds bounds_of(std::span<const glm::dvec3> positions, std::span<const glm::ivec3> triangles) {
    Bounds box{glm::dvec3(std::numeric_limits<double>::infinity()), glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const glm::ivec3& t : triangles) {
        if (!can_be_drawn(t, positions)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = positions[static_cast<std::size_t>(t[k])];
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
    }
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

}   // namespace render
