#include "mesh/triangle_kind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meshfolio {

static const double sin_of_needle = std::sin(std::numbers::pi / 180);

TriangleKind kind_of(const TriangleMesh& mesh, int t) {
    const Vector3 a = mesh.X.row(mesh.F(t, 0));
    const Vector3 u = mesh.X.row(mesh.F(t, 1)).transpose() - a;
    const Vector3 v = mesh.X.row(mesh.F(t, 2)).transpose() - a;
    const Vector3 cross = u.cross(v);
    // Most triangles are sound by squares alone, with a margin for rounding and for the range of a double.
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), ww = (v - u).squaredNorm(), longer_two = std::max({uu * vv, vv * ww, ww * uu});
    if (longer_two > 1e-200 && cross.squaredNorm() > (1 + 1e-9) * sin_of_needle * sin_of_needle * longer_two) return TriangleKind::sound;
    std::array<double, 3> edge{u.norm(), v.norm(), (v - u).norm()};
    std::sort(edge.begin(), edge.end());
    const double twice_area = std::hypot(cross.x(), cross.y(), cross.z());
    if (!(twice_area > no_area * edge[2] * edge[2])) return TriangleKind::zero_area;
    // The smallest angle lies between the two longer edges.
    return twice_area < sin_of_needle * edge[1] * edge[2] ? TriangleKind::needle : TriangleKind::sound;
}

}   // namespace meshfolio
