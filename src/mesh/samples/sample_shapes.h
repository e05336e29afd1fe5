/// @file
/// Procedural meshes: the bundled data, and test surfaces with closed forms. Coordinates of the named samples are
/// rounded to 7 significant digits, so that every machine makes the same bytes.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// A bundled mesh: `data/<name>.<format>` is exactly what `make` returns.
struct Sample {
    std::string_view name;                 // "bumpy_cube"
    std::string_view description;          // one line for `meshfolio sample --list`
    TriangleMesh (*make)(int subdivide);   // extra 1-to-4 subdivisions onto the surface; 0 is the bundled mesh
};
std::span<const Sample> sample_list();

inline constexpr int most_subdivisions = 6;   // already 4096 times as many triangles

/// @throws UsageError naming the nearest known sample, or for more subdivisions than that
TriangleMesh make_sample(const std::string& name, int subdivide = 0);

// Surfaces with closed forms. `level`/`n` refine them; 2× finer divides the mean edge by two.
TriangleMesh icosphere(int level, double radius = 1);
TriangleMesh ellipsoid_mesh(int level, const Vector3& half_axes);
TriangleMesh torus_mesh(int around, int across, double R, double r);
/// Points (x, y, height(x, y)) of an nx × ny grid over [0, width] × [0, depth], each square cut along one diagonal.
TriangleMesh grid_mesh(int nx, int ny, double width, double depth, double (*height)(double x, double y) = nullptr);
/// A cube of half-edge `half` with each side divided n × n; n = 1 has 8 vertices and 12 triangles.
TriangleMesh cube_mesh(int n, double half = 0.5);
/// Every triangle into four through its edge midpoints.
TriangleMesh subdivide_midpoint(const TriangleMesh& mesh);

}   // namespace meshfolio
