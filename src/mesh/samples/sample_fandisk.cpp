// A machine part in the spirit of the fan disk: a sector of a turned body with hub, web and rim, cut by planes and steps.
// Straight and circular edges, convex and concave ones, a cylinder, a fillet, a bulging rim, and a crease on the rim that
// fades away into a smooth surface. Blocks in (radius, angle, height) give its combinatorics; all sharp edges are block edges.
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/samples/block_solid.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio {

namespace {

/// Returns the piecewise linear function through values[0], values[1], … at 0, 1, …
template <std::size_t n> double piecewise(const std::array<double, n>& values, double x) {
    const std::size_t i = std::min(static_cast<std::size_t>(x), n - 2);
    return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

// Blocks along the radius: hub, web, inner and outer half of the rim. Along the angle: low end, middle, high end.
// Along the height: base plate, body, top.
const BlockDivisions divisions{{{6, 12, 5, 6}, {15, 15, 15}, {7, 7, 8}}};

bool is_filled(int radius, int angle, int height) {
    if (height == 0) return !(radius == 3 && angle == 1);                // a notch in the rim's foot
    if (height == 1) return radius != 1;                                 // the web is thin
    return (radius == 0 && angle <= 1) || (radius >= 2 && angle >= 1);   // hub and rim rise over different angles
}

/// Returns x − i, clamped to [0, 1].
double within(double x, double i) { return std::clamp(x - i, 0.0, 1.0); }

/// Returns a parabola: 0 at both ends of [0, 1], 1 in the middle.
double arc(double t) { return 4 * t * (1 - t); }

/// Returns the point in space of block coordinates (radius, angle, height). The axis is z; the sector stands upright.
Vector3 bent(const Vector3& block) {
    constexpr std::array<double, 5> radii{0.8, 1.08, 1.7, 1.95, 2.2};
    constexpr std::array<double, 4> angles{-0.72, -0.25, 0.25, 0.72}, heights{-0.5, -0.15, 0.2, 0.55};
    const double hub = 1 - within(block[0], 0), web = within(block[0], 1), rim = within(block[0], 2), outer_rim = within(block[0], 3);
    const double base = within(block[2], 0), middle = within(block[2], 1), top = within(block[2], 2);
    const double turned = block[1] / 3, turned_below = 1 - within(block[1], 0), turned_above = within(block[1] / 2, 0.5);

    double r = piecewise(radii, block[0]), angle = piecewise(angles, block[1]), z = piecewise(heights, block[2]);
    r -= 0.3 * smooth_step(turned) * web;                                                // the web tapers off
    r += 0.09 * arc(block[2] / 3) * outer_rim;                                           // the rim bulges
    angle += 0.16 * (1 - turned) * arc(block[0] / 4);                                    // one end is curved
    z -= 0.17 * arc(web) * base;                                                         // the web is hollow
    z -= 0.15 * turned_below * turned_below * hub * top;                                 // the hub falls off
    z += 0.1 * hub * top;                                                                // and leans
    z -= 0.14 * (rim + outer_rim) / 2 * middle * (1 - top);                              // the low rim is a cone
    z += 0.18 * smooth_step(turned_above) * (1 - std::abs(rim + outer_rim - 1)) * top;   // a crease along the rim rises from nothing
    return {-r * std::sin(angle), r * std::cos(angle), z};
}

}   // namespace

TriangleMesh fandisk_sample(int subdivide) {
    const BlockSurface surface = surface_of_blocks(divisions, is_filled);
    TriangleMesh mesh = triangulated(surface, [](const BlockSurface& s, int q) {
        const auto [a, b, c, d] = s.quads[static_cast<std::size_t>(q)];
        const auto length = [&](int i, int j) { return (bent(s.X.row(i)) - bent(s.X.row(j))).norm(); };
        return length(a, c) <= length(b, d) + 1e-9;
    });
    for (int i = 0; i < subdivide; ++i) mesh = subdivide_midpoint(mesh);   // of the blocks, before they are bent
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.X.row(v) = bent(mesh.X.row(v));
    return mesh;
}

}   // namespace meshfolio
