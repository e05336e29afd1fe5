// A rounded cube with the pips of a die as smooth bumps: 1 on +z, 2 on +x, 3 on +y, opposite sides adding up to seven, so
// that each of the six views is known by its number.
#include <array>
#include <utility>
#include <vector>

#include "mesh/samples/implicit_surface.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/samples/signed_distance.h"

namespace meshfolio {

namespace {

using Pips = std::vector<std::pair<double, double>>;   // places on a side, in units of the distance between rows

Pips pips_of(int number) {
    static const std::array<Pips, 3> pairs{{{{-1, -1}, {1, 1}}, {{-1, 1}, {1, -1}}, {{-1, 0}, {1, 0}}}};
    Pips pips;
    if (number % 2 == 1) pips.emplace_back(0, 0);
    for (int i = 0; i < number / 2; ++i)
        pips.insert(pips.end(), pairs[static_cast<std::size_t>(i)].begin(), pairs[static_cast<std::size_t>(i)].end());
    return pips;
}

std::vector<Ball> bumps() {
    constexpr double half = 0.8, row = 0.42, height = 0.16;   // of each bump above the side
    std::vector<Ball> balls;
    for (int axis = 0; axis < 3; ++axis) {
        const int number = std::array{2, 3, 1}[static_cast<std::size_t>(axis)];
        for (const int side : {1, -1}) {
            const int pips = side > 0 ? number : 7 - number;
            const double radius = 0.36 - 0.023 * pips;   // the fewer, the larger
            for (const auto& [u, v] : pips_of(pips)) {
                Vector3 centre;
                centre[axis] = side * (half + height - radius);
                centre[(axis + 1) % 3] = row * u;
                centre[(axis + 2) % 3] = row * v;
                balls.push_back({centre, radius});
            }
        }
    }
    return balls;
}

double bumpy_cube(const Vector3& p) {
    static const RoundBox box{{0.8, 0.8, 0.8}, 0.3};
    static const std::vector<Ball> balls = bumps();
    double d = signed_distance(box, p);
    for (const Ball& ball : balls) d = smooth_union(d, signed_distance(ball, p), 0.16);
    return d;
}

}   // namespace

TriangleMesh bumpy_cube_sample(int subdivide) {
    // The box is not symmetric about the cube, so that no node of the grid lies on a plane of symmetry.
    const Box box{{-1.083, -1.072, -1.061}, {1.1, 1.1, 1.1}};
    const TriangleMesh mesh = relaxed_on(bumpy_cube, surface_net(bumpy_cube, box, 0.0631), 20);
    return subdivided_onto(mesh, subdivide, [](const Vector3& p) { return projected(bumpy_cube, p, 4); });
}

}   // namespace meshfolio
