/// @file
/// Convex pieces of a triangle, for the search for the farthest point. Private to the layer.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/at.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// A convex polygon in a plane of space.
struct Piece {
    static constexpr int most_corners_to_cut = 8, most_corners = most_corners_to_cut + 4;   // three cuts add a corner each
    using Values = std::array<double, most_corners>;                                        // one a corner

    double bound = 0;   // of the distance of any of its points [length]
    int count = 0, depth = 0;
    std::array<Vector3, most_corners> corners;   // in order around it

    bool operator<(const Piece& other) const { return bound < other.bound; }
    std::span<const Vector3> points() const { return std::span(corners).first(at(count)); }
    void add(const Vector3& corner) { corners[at(count++)] = corner; }

    Vector3 centre() const {
        Vector3 sum = Vector3::Zero();
        for (const Vector3& p : points()) sum += p;
        return sum / count;
    }
    double radius(const Vector3& around) const {
        double squared = 0;
        for (const Vector3& p : points()) squared = std::max(squared, (p - around).squaredNorm());
        return std::sqrt(squared);
    }

    /// Returns the parts where the values, linear along the sides, are ≥ 0 and ≤ 0. A part with fewer than three corners has no area.
    std::pair<Piece, Piece> cut(const Values& values) const {
        std::pair<Piece, Piece> parts;
        parts.first.depth = parts.second.depth = depth + 1;
        for (int i = 0; i < count; ++i) {
            const std::size_t here = at(i), next = at(i + 1 == count ? 0 : i + 1);
            if (values[here] >= 0) parts.first.add(corners[here]);
            if (values[here] <= 0) parts.second.add(corners[here]);
            if ((values[here] > 0 && values[next] < 0) || (values[here] < 0 && values[next] > 0)) {
                const Vector3 between = corners[here] + values[here] / (values[here] - values[next]) * (corners[next] - corners[here]);
                parts.first.add(between);
                parts.second.add(between);
            }
        }
        return parts;
    }

    /// Returns two parts, cut across the direction of the corner farthest from `around`, a point of the piece, so that parts become round;
    /// a piece with many corners is cut along a diagonal, which adds none.
    std::pair<Piece, Piece> halves(const Vector3& around) const {
        Values values{};
        if (count > most_corners_to_cut) {
            for (int i = 1; i < count; ++i) values[at(i)] = i == count / 2 ? 0 : i < count / 2 ? 1 : -1;
            return cut(values);
        }
        Vector3 along = Vector3::Zero();
        for (const Vector3& p : points())
            if ((p - around).squaredNorm() > along.squaredNorm()) along = p - around;
        for (int i = 0; i < count; ++i) values[at(i)] = along.dot(corners[at(i)] - around);
        return cut(values);
    }
};

}   // namespace meshfolio
