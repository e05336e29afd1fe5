/// @file
/// Procedural meshes: the bundled data, and test surfaces with closed forms. Coordinates of the named samples are rounded to 7 significant
/// digits, so that every machine makes the same bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// A bundled mesh: `data/<name>.<format>` holds the mesh that `make(0)` returns.
struct Sample {
    std::string_view name;                 // "bumpy_cube"
    std::string_view description;          // one line for `meshfolio sample --list`
    TriangleMesh (*make)(int subdivide);   // extra 1-to-4 subdivisions onto the surface; 0 is the bundled mesh
};
/// Returns the bundled samples, in the order of `meshfolio sample --list`.
std::span<const Sample> sample_list();

inline constexpr int most_subdivisions = 6;   // already 4096 times as many triangles

/// Returns the sample named `name`. @throws UsageError for an unknown name (with the nearest one), or `subdivide` below 0 or above
/// most_subdivisions
TriangleMesh make_sample(const std::string& name, int subdivide = 0);

/// Returns a sphere about the origin: an icosahedron with each triangle divided into four, `level` times.
TriangleMesh icosphere(int level, double radius = 1);
/// Returns icosphere(level), scaled along the axes.
TriangleMesh ellipsoid_mesh(int level, const Vector3& half_axes);
/// Returns a torus about the z axis, of radii R (to the tube's centre) and r (of the tube), with around × across vertices.
TriangleMesh torus_mesh(int around, int across, double R, double r);
/// Returns the points (x, y, height(x, y)) of an nx × ny grid over [0, width] × [0, depth], each square cut along one diagonal; z = 0
/// without `height`. Rows of points follow one another in x.
TriangleMesh grid_mesh(int nx, int ny, double width, double depth, double (*height)(double x, double y) = nullptr);
/// Returns a cube of half-edge `half` about the origin, each side divided n × n; n = 1 has 8 vertices and 12 triangles.
TriangleMesh cube_mesh(int n, double half = 0.5);
/// Returns the convex hull of the six points on the axes of the unit sphere and `points` − 6 random, uniformly distributed ones: 2·points −
/// 4 triangles, as irregular as a Delaunay mesh can be. @throws UsageError for fewer than six points
TriangleMesh random_sphere(int points, std::uint64_t seed);
/// Returns the mesh with every triangle divided into four at its edge midpoints; the old vertices keep their rows.
TriangleMesh subdivide_midpoint(const TriangleMesh& mesh);

}   // namespace meshfolio
