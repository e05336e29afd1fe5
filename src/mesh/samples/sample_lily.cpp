// A lily: six petals grown together into a tube at the bottom, opening towards +z. One open surface with the topology of a
// tube: its two boundary loops are the ring at the bottom and the outline of the petals.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/samples/sample_parts.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio {

namespace {

constexpr int petals = 6;
constexpr double tube_end = 0.25;   // along the midrib: above, the petals are separate
constexpr double half_angle = std::numbers::pi / petals;

/// How far up the free part of a petal, in [0, 1].
double along_petal(double u) { return std::max(0.0, (u - tube_end) / (1 - tube_end)); }

/// A point of the midrib in the half plane through the axis, and the direction there from the petal to the inside of the flower.
struct MidribPoint {
    double from_axis, height;
    double inwards_from_axis, inwards_height;
};

/// A cubic Bézier curve; every other petal bends farther back.
MidribPoint midrib(double u, bool bent_back) {
    constexpr std::array<double, 4> out{0.09, 0.13, 0.4, 1.2}, up{0, 0.7, 1.25, 0.92};
    const double s = 1 - u, t = along_petal(u);
    const auto value = [&](const auto& p) { return s * s * s * p[0] + 3 * s * s * u * p[1] + 3 * s * u * u * p[2] + u * u * u * p[3]; };
    const auto slope = [&](const auto& p) { return s * s * (p[1] - p[0]) + 2 * s * u * (p[2] - p[1]) + u * u * (p[3] - p[2]); };
    const double speed = std::hypot(slope(out), slope(up)), turned = smooth_step(t);
    const double sag = (bent_back ? 0.3 : 0.0) * t * t * t;
    return {value(out) + 0.1 * sag, value(up) - sag, -(1 - turned) - turned * slope(up) / speed, turned * slope(out) / speed};
}

/// Half the chord of a petal across. In the tube: of a sixth of the circle.
double half_width(double u, bool bent_back) {
    const double t = along_petal(u), narrowing = std::sqrt(1 - t) * std::sqrt(std::sqrt(1 - t));
    const double of_tube = midrib(std::min(u, tube_end), bent_back).from_axis * std::sin(half_angle);
    return (of_tube + (bent_back ? 0.78 : 1.06) * t * std::sqrt(t)) * narrowing;
}

/// The point u ∈ [0, 1] along and v ∈ [−1, 1] across one petal. In the tube it lies on a circle about the axis.
Vector3 petal_point(double u, double v, int petal) {
    const bool bent_back = petal % 2 == 1;
    const MidribPoint rib = midrib(u, bent_back);
    const double t = along_petal(u), w = half_width(u, bent_back);
    const double across = w * std::sin(v * half_angle) / std::sin(half_angle);
    const double cupped = (1 - 1.5 * smooth_step(t)) * w * (1 - std::cos(v * half_angle)) / std::sin(half_angle);
    const double groove = 0.12 * t * (1 - t) * std::pow(1 - v * v, 4);
    const double ruffle = 0.3 * t * t * (1 - t) * v * v * v * std::sin(11 * u + 2 * petal);
    const double behind = bent_back ? 0.09 * smooth_step(std::min(1.0, 2 * t)) : 0.0;   // the petals nearly overlap and must not meet
    const double lift = cupped - groove + ruffle - behind;
    const double from_axis = rib.from_axis + lift * rib.inwards_from_axis;
    const double cos = std::cos(2 * half_angle * petal), sin = std::sin(2 * half_angle * petal);
    return {from_axis * cos - across * sin, from_axis * sin + across * cos, rib.height + lift * rib.inwards_height};
}

/// Triangles between two rows of `lower` and `upper` segments, numbered from `first_lower` and `first_upper`.
void stitch(int lower, int upper, int first_lower, int first_upper, std::vector<int>& corners) {
    for (int a = 0, b = 0; a < lower || b < upper;) {
        const bool step_below = b == upper || (a < lower && (2 * a + 1) * upper <= (2 * b + 1) * lower);
        corners.insert(corners.end(), {first_lower + a, first_upper + b, step_below ? first_lower + a + 1 : first_upper + b + 1});
        ++(step_below ? a : b);
    }
}

/// Rows across one petal, as many points in each as its width takes. Rows of X are (u, v, petal).
TriangleMesh petal_parameters(int petal) {
    constexpr int rows = 36;
    constexpr double spacing = 0.058;
    std::vector<double> coordinates;
    std::vector<int> corners;
    for (int row = 0, last_segments = 0; row <= rows; ++row) {
        const double u = static_cast<double>(row) / rows;
        const double width = 2 * half_width(std::max(u, tube_end), petal % 2 == 1);
        const int segments = row == rows ? 0 : std::max(2, static_cast<int>(std::lround(width / spacing)));
        const int first = static_cast<int>(coordinates.size() / 3);
        for (int i = 0; i <= segments; ++i) {
            const double v = segments == 0 ? 0 : static_cast<double>(2 * i - segments) / segments;
            coordinates.insert(coordinates.end(), {u, v, static_cast<double>(petal)});
        }
        if (row > 0) stitch(last_segments, segments, first - last_segments - 1, first, corners);
        last_segments = segments;
    }
    return {Eigen::Map<const Positions>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3),
            Eigen::Map<const Faces>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3)};
}

/// All petals one after the other, in parameters.
TriangleMesh flower_parameters(int subdivide) {
    TriangleMesh all;
    for (int petal = 0; petal < petals; ++petal) {
        TriangleMesh one = petal_parameters(petal);
        for (int i = 0; i < subdivide; ++i) one = subdivide_midpoint(one);
        const Eigen::Index n = all.X.rows(), m = all.F.rows();
        all.X.conservativeResize(n + one.X.rows(), 3);
        all.F.conservativeResize(m + one.F.rows(), 3);
        all.X.bottomRows(one.X.rows()) = one.X;
        all.F.bottomRows(one.F.rows()) = one.F.array() + static_cast<int>(n);
    }
    return all;
}

/// In the tube, the right edge of a petal is the left edge of the next: the same u, v = 1 and v = −1.
Faces joined_in_the_tube(const TriangleMesh& parameters) {
    std::map<std::pair<int, double>, int> left_edge;   // (petal, u) → vertex
    const auto in_tube = [&](int i) { return parameters.X(i, 0) <= tube_end; };
    for (int i = 0; i < parameters.vertex_count(); ++i)
        if (in_tube(i) && parameters.X(i, 1) == -1) left_edge[{static_cast<int>(parameters.X(i, 2)), parameters.X(i, 0)}] = i;
    std::vector<int> joined(static_cast<std::size_t>(parameters.vertex_count()));
    for (int i = 0; i < parameters.vertex_count(); ++i) {
        const int next_petal = (static_cast<int>(parameters.X(i, 2)) + 1) % petals;
        joined[static_cast<std::size_t>(i)] = in_tube(i) && parameters.X(i, 1) == 1 ? left_edge.at({next_petal, parameters.X(i, 0)}) : i;
    }
    return parameters.F.unaryExpr([&](int i) { return joined[static_cast<std::size_t>(i)]; });
}

}   // namespace

TriangleMesh lily_sample(int subdivide) {
    TriangleMesh lily = flower_parameters(subdivide);
    lily.F = joined_in_the_tube(lily);
    for (int i = 0; i < lily.vertex_count(); ++i) {
        const Vector3 parameter = lily.X.row(i);
        lily.X.row(i) = petal_point(parameter[0], parameter[1], static_cast<int>(parameter[2]));
    }
    return without_unreferenced_vertices(lily).mesh;
}

}   // namespace meshfolio
