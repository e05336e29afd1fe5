#include "geometry/operators/intrinsic_delaunay.h"

#include <array>
#include <cmath>
#include <deque>
#include <string>

#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/triangle_shape.h"

namespace meshfolio {

namespace {

constexpr double angle_tolerance = 1e-10;   // [rad]

/// Corner 0 of a triangle lies at the apex over the side it is opposite to.
struct Apex {
    double along, height;   // from the start of the side, and above it [length]
};

/// The triangle over a side from the origin along x: `before` is the side at its start, `after` the one at its end.
Apex apex_over(double side, double before, double after) {
    const double along = side > 0 ? 0.5 * (side + (before - after) * ((before + after) / side)) : 0;
    return {along, side > 0 ? triangle_shape(side, before, after).cross / side : before};
}

class Flipper {
public:
    explicit Flipper(IntrinsicTriangles& triangles) : triangles_(triangles), waiting_(triangles.glued_to.size(), 0) {}

    int run() {
        for (std::size_t side = 0; side < triangles_.glued_to.size(); ++side) wait(static_cast<int>(side));
        const long long most = 1000 + 100 * static_cast<long long>(triangles_.glued_to.size());
        int flips = 0;
        while (!queue_.empty()) {
            const int side = queue_.front();
            queue_.pop_front();
            waiting_[static_cast<std::size_t>(side)] = 0;
            if (!wants_flip(side)) continue;
            flip(side);
            if (++flips > most) throw SolverError("intrinsic Delaunay: no end after " + std::to_string(flips) + " flips");
        }
        return flips;
    }

private:
    int& mate(int side) { return triangles_.glued_to[static_cast<std::size_t>(side)]; }
    static int next(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
    double length(int side) const { return triangles_.lengths(side / 3, side % 3); }
    int apex(int side) const { return triangles_.F(side / 3, side % 3); }

    /// An edge waits under one of its sides.
    void wait(int side) {
        if (mate(side) == IntrinsicTriangles::not_glued) return;
        char& flag = waiting_[static_cast<std::size_t>(side)];
        if (flag != 0 || waiting_[static_cast<std::size_t>(mate(side))] != 0) return;
        flag = 1;
        queue_.push_back(side);
    }

    double opposite_angle(int side) const {
        const TriangleShape shape = triangle_shape(length(side), length(next(side)), length(next(next(side))));
        return std::atan2(shape.cross, shape.dot[0]);
    }

    /// Two sides of one triangle glued together make a cone, whose edge is the only one there is.
    bool wants_flip(int side) {
        const int other = mate(side);
        if (other == IntrinsicTriangles::not_glued || other / 3 == side / 3) return false;
        return opposite_angle(side) + opposite_angle(other) > pi + angle_tolerance;
    }

    /// The length of the other diagonal of the two triangles laid out in the plane.
    double diagonal(int side, int other) const {
        const double l = length(side);
        const Apex above = apex_over(l, length(next(next(side))), length(next(side)));
        const Apex below = apex_over(l, length(next(other)), length(next(next(other))));
        return std::hypot(above.along - below.along, above.height + below.height);
    }

    /// Triangles (a, i, j) and (b, j, i) over the edge ij become (a, i, b) and (b, j, a) over ab.
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
        for (const int outer : after) wait(outer);
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
