#include "geometry/operators/intrinsic_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <tuple>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/triangle_shape.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr double angle_tolerance = 1e-10;   // [rad]

/// The corner opposite a side that lies along x.
struct Apex {
    double along, height;   // from the start of the side, and above it [length]
};

/// Returns the apex of a triangle over a side from the origin along x; `before` is the length of the side at its start, `after` at its end.
Apex apex_over(double side, double before, double after) {
    const double along = side > 0 ? 0.5 * (side + (before - after) * ((before + after) / side)) : 0;
    return {along, side > 0 ? triangle_shape(side, before, after).cross / side : before};
}

class Flipper {
public:
    explicit Flipper(IntrinsicTriangles& triangles) : triangles_(triangles), waiting_(triangles.glued_to.size(), 0) {}

    int run() {
        for (std::size_t side = 0; side < triangles_.glued_to.size(); ++side) enqueue(static_cast<int>(side));
        const long long most = 1000 + 100 * static_cast<long long>(triangles_.glued_to.size());
        int flips = 0;
        while (!queue_.empty()) {
            const int side = queue_.front();
            queue_.pop_front();
            waiting_[at(side)] = 0;
            if (!needs_flip(side)) continue;
            flip(side);
            if (++flips > most)
                throw SolverError("intrinsic Delaunay: the flips do not end (" + std::to_string(flips) + " done)",
                                  "repair triangles of zero area");
        }
        return flips;
    }

private:
    int& mate(int side) { return triangles_.glued_to[at(side)]; }
    static int next(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
    double length(int side) const { return triangles_.lengths(side / 3, side % 3); }
    int apex(int side) const { return triangles_.F(side / 3, side % 3); }

    /// Queues an edge under one of its sides.
    void enqueue(int side) {
        if (mate(side) == IntrinsicTriangles::not_glued) return;
        char& flag = waiting_[at(side)];
        if (flag != 0 || waiting_[at(mate(side))] != 0) return;
        flag = 1;
        queue_.push_back(side);
    }

    double opposite_angle(int side) const {
        const TriangleShape shape = triangle_shape(length(side), length(next(side)), length(next(next(side))));
        return std::atan2(shape.cross, shape.dot[0]);
    }

    /// True if the edge is not Delaunay. The edge of a cone, two sides of one triangle glued together, cannot be flipped.
    bool needs_flip(int side) {
        const int other = mate(side);
        if (other == IntrinsicTriangles::not_glued || other / 3 == side / 3) return false;
        return opposite_angle(side) + opposite_angle(other) > pi + angle_tolerance;
    }

    /// Returns the length of the other diagonal of the two triangles, laid out in the plane.
    double diagonal(int side, int other) const {
        const double l = length(side);
        const Apex above = apex_over(l, length(next(next(side))), length(next(side)));
        const Apex below = apex_over(l, length(next(other)), length(next(next(other))));
        return std::hypot(above.along - below.along, above.height + below.height);
    }

    /// Flips an edge: triangles (a, i, j) and (b, j, i) over the edge ij become (a, i, b) and (b, j, a) over ab.
    void flip(int side) {
        const int other = mate(side), t = side / 3, u = other / 3;
        const int a = apex(side), b = apex(other), i = apex(next(side)), j = apex(next(next(side)));
        const double ab = diagonal(side, other);
        // The four outer sides ib, ai, ja, bj before and after.
        const std::array before{next(other), next(next(side)), next(side), next(next(other))};
        const std::array after{3 * t, 3 * t + 2, 3 * u, 3 * u + 2};
        std::array<int, 4> mates{};
        std::array<double, 4> lengths{};
        for (std::size_t k = 0; k < 4; ++k) {
            mates[k] = mate(before[k]);
            lengths[k] = length(before[k]);
            for (std::size_t m = 0; m < 4; ++m)
                if (mate(before[k]) == before[m]) mates[k] = after[m];
        }
        triangles_.F.row(t) << a, i, b;
        triangles_.F.row(u) << b, j, a;
        triangles_.lengths.row(t) << lengths[0], ab, lengths[1];
        triangles_.lengths.row(u) << lengths[2], ab, lengths[3];
        glue(3 * t + 1, 3 * u + 1);
        for (std::size_t k = 0; k < 4; ++k) glue(after[k], mates[k]);
        for (const int outer : after) enqueue(outer);
    }

    void glue(int side, int other) {
        mate(side) = other;
        if (other != IntrinsicTriangles::not_glued) mate(other) = side;
    }

    IntrinsicTriangles& triangles_;
    std::vector<char> waiting_;
    std::deque<int> queue_;
};

}   // namespace

void for_each_edge(const Faces& F, const std::function<void(std::span<const SideOfEdge>)>& visit) {
    std::vector<SideOfEdge> sides;
    sides.reserve(3 * static_cast<std::size_t>(F.rows()));
    for (int t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int from = F(t, (k + 1) % 3), to = F(t, (k + 2) % 3);
            sides.push_back({std::min(from, to), std::max(from, to), 3 * t + k, from < to});
        }
    }
    std::sort(sides.begin(), sides.end(),
              [](const SideOfEdge& a, const SideOfEdge& b) { return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side); });
    for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
        last = std::find_if(first, sides.end(), [&](const SideOfEdge& s) { return s.low != first->low || s.high != first->high; });
        visit({first, last});
    }
}

IntrinsicTriangles intrinsic_triangles(const TriangleMesh& mesh) {
    IntrinsicTriangles triangles{mesh.F, edge_lengths(mesh), {}, mesh.vertex_count()};
    triangles.glued_to.assign(3 * at(mesh.face_count()), IntrinsicTriangles::not_glued);
    for_each_edge(mesh.F, [&](std::span<const SideOfEdge> sides) {
        if (sides.size() != 2 || sides[0].ascending == sides[1].ascending) return;
        triangles.glued_to[at(sides[0].side)] = sides[1].side;
        triangles.glued_to[at(sides[1].side)] = sides[0].side;
    });
    return triangles;
}

void require_corner_values(const std::string& function, const Faces& F, int vertex_count, const CornerValues& values) {
    if (values.rows() != F.rows()) {
        throw MeshError(
            function + ": corner values for " + std::to_string(values.rows()) + " triangles, but there are " + std::to_string(F.rows()),
            "give a row a triangle");
    }
    if (F.rows() > 0 && (F.minCoeff() < 0 || F.maxCoeff() >= vertex_count)) {
        throw MeshError(function + ": a triangle names vertex " + std::to_string(F.minCoeff() < 0 ? F.minCoeff() : F.maxCoeff()) +
                            ", but there are " + std::to_string(vertex_count) + " vertices",
                        "indices count from 0");
    }
}

void require_lengths(const std::string& function, const CornerValues& lengths) {
    for (Eigen::Index t = 0; t < lengths.rows(); ++t)
        if (!lengths.row(t).allFinite() || lengths.row(t).minCoeff() < 0)
            throw MeshError(function + ": triangle " + std::to_string(t) + " has an edge length that is negative or not finite",
                            "repair it");
}

IntrinsicDelaunay intrinsic_delaunay(IntrinsicTriangles triangles) {
    IntrinsicDelaunay result{std::move(triangles), 0};
    const double longest = result.triangles.lengths.size() > 0 ? result.triangles.lengths.maxCoeff() : 0;
    if (!(longest > 0)) return result;
    const double unit = std::exp2(std::ilogb(longest));   // exact, and fourth powers of lengths stay within range
    result.triangles.lengths /= unit;
    result.flips = Flipper(result.triangles).run();
    result.triangles.lengths *= unit;
    return result;
}

}   // namespace meshfolio
