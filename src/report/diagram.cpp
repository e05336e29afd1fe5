#include "report/diagram.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace meshfolio::report {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Returns the directions from `vertex` to `a` and to `b` [radians], at most half a turn apart.
std::pair<double, double> angles_between(DiagramPoint vertex, DiagramPoint a, DiagramPoint b) {
    const double from = std::atan2(a[1] - vertex[1], a[0] - vertex[0]), to = std::atan2(b[1] - vertex[1], b[0] - vertex[0]);
    return {from, from + std::remainder(to - from, turn)};
}

}   // namespace

Diagram::Path path_through(const std::vector<DiagramPoint>& points, Diagram::Style style, bool closed) {
    Diagram::Path path;
    path.style = style;
    path.closed = closed;
    for (const auto& [x, y] : points) {
        path.x.push_back(x);
        path.y.push_back(y);
    }
    return path;
}

Diagram::Path arc(DiagramPoint centre, double radius, double from, double to, Diagram::Style style) {
    const int steps = 1 + static_cast<int>(std::abs(to - from) / turn * 72);   // of 5 degrees at most
    std::vector<DiagramPoint> points;
    for (int i = 0; i <= steps; ++i) {
        const double angle = from + (to - from) * i / steps;
        points.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
    }
    return path_through(points, style);
}

Diagram::Path angle_arc(DiagramPoint vertex, DiagramPoint a, DiagramPoint b, double radius, Diagram::Style style) {
    const auto [from, to] = angles_between(vertex, a, b);
    return arc(vertex, radius, from, to, style);
}

DiagramPoint inside_angle(DiagramPoint vertex, DiagramPoint a, DiagramPoint b, double radius) {
    const auto [from, to] = angles_between(vertex, a, b);
    const double middle = 0.5 * (from + to);
    return {vertex[0] + radius * std::cos(middle), vertex[1] + radius * std::sin(middle)};
}

}   // namespace meshfolio::report
