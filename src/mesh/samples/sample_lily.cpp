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

/// Returns the place along the free part of a petal, in [0, 1].
double along_petal(double u) { return std::max(0.0, (u - tube_end) / (1 - tube_end)); }

/// A point of the midrib in the half plane through the axis, and the direction there from the petal to the inside of the flower.
struct MidribPoint {
    double from_axis, height;
    double inwards_from_axis, inwards_height;
};

/// Returns a point of a cubic Bézier curve; every other petal bends farther back.
MidribPoint midrib(double u, bool bent_back) {
    constexpr std::array<double, 4> out{0.09, 0.13, 0.4, 1.2}, up{0, 0.7, 1.25, 0.92};
    const double s = 1 - u, t = along_petal(u);
    const auto value = [&](const auto& p) { return s * s * s * p[0] + 3 * s * s * u * p[1] + 3 * s * u * u * p[2] + u * u * u * p[3]; };
    const auto slope = [&](const auto& p) { return s * s * (p[1] - p[0]) + 2 * s * u * (p[2] - p[1]) + u * u * (p[3] - p[2]); };
    const double speed = std::hypot(slope(out), slope(up)), turned = smooth_step(t);
    const double sag = (bent_back ? 0.3 : 0.0) * t * t * t;
    return {value(out) + 0.1 * sag, value(up) - sag, -(1 - turned) - turned * slope(up) / speed, turned * slope(out) / speed};
}

/// Returns half the chord across a petal; in the tube, across a sixth of the circle.
double half_width(double u, bool bent_back) {
    const double t = along_petal(u), narrowing = std::sqrt(1 - t) * std::sqrt(std::sqrt(1 - t));
    const double of_tube = midrib(std::min(u, tube_end), bent_back).from_axis * std::sin(half_angle);
    return (of_tube + (bent_back ? 0.78 : 1.06) * t * std::sqrt(t)) * narrowing;
}

/// Returns the point at u ∈ [0, 1] along and v ∈ [−1, 1] across a petal. In the tube it lies on a circle about the axis.
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

/// Returns a petal of rows of triangles, with as many points in a row as its width takes. Rows of X are (u, v, petal).
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
        const int first_below = first - last_segments - 1;
        for (int a = 0, b = 0; row > 0 && (a < last_segments || b < segments);) {   // between this row and the one below
            const bool step_below = b == segments || (a < last_segments && (2 * a + 1) * segments <= (2 * b + 1) * last_segments);
            corners.insert(corners.end(), {first_below + a, first + b, step_below ? first_below + a + 1 : first + b + 1});
            ++(step_below ? a : b);
        }
        last_segments = segments;
    }
    return {Eigen::Map<const Positions>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3),
            Eigen::Map<const Faces>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3)};
}

}   // namespace

TriangleMesh lily_sample(int subdivide) {
    TriangleMesh lily;   // rows of X are (u, v, petal) at first
    for (int petal = 0; petal < petals; ++petal) {
        TriangleMesh one = petal_parameters(petal);
        for (int i = 0; i < subdivide; ++i) one = subdivide_midpoint(one);
        const Eigen::Index n = lily.X.rows(), m = lily.F.rows();
        lily.X.conservativeResize(n + one.X.rows(), 3);
        lily.F.conservativeResize(m + one.F.rows(), 3);
        lily.X.bottomRows(one.X.rows()) = one.X;
        lily.F.bottomRows(one.F.rows()) = one.F.array() + static_cast<int>(n);
    }
    // In the tube, the right edge of a petal (v = 1) is the left edge of the next (v = −1).
    std::map<std::pair<int, double>, int> left_edge;   // (petal, u) → vertex
    const auto petal_of = [&](int i) { return static_cast<int>(lily.X(i, 2)); };
    for (int i = 0; i < lily.vertex_count(); ++i)
        if (lily.X(i, 1) == -1) left_edge[{petal_of(i), lily.X(i, 0)}] = i;
    for (int& i : lily.F.reshaped())
        if (lily.X(i, 0) <= tube_end && lily.X(i, 1) == 1) i = left_edge.at({(petal_of(i) + 1) % petals, lily.X(i, 0)});
    for (int i = 0; i < lily.vertex_count(); ++i) {
        const Vector3 parameter = lily.X.row(i);
        lily.X.row(i) = petal_point(parameter[0], parameter[1], static_cast<int>(parameter[2]));
    }
    return without_unreferenced_vertices(lily).mesh;
}

}   // namespace meshfolio
