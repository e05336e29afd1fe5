// Surfaces with closed forms: sphere, ellipsoid, torus, graph over a grid, cube.
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/errors.h"
#include "mesh/samples/block_solid.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio {

namespace {

void require(bool holds, const char* problem) {
    if (!holds) throw UsageError(problem);
}

TriangleMesh icosahedron() {
    constexpr double g = std::numbers::phi;
    TriangleMesh mesh;
    mesh.X.resize(12, 3);
    mesh.X << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0,   //
        0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g,         //
        g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, 1;
    mesh.F.resize(20, 3);
    mesh.F << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11,   //
        1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8,         //
        3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9,             //
        4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;
    return mesh;
}

}   // namespace

TriangleMesh subdivide_midpoint(const TriangleMesh& mesh) {
    std::map<std::pair<int, int>, int> midpoint;   // numbered in the order of the triangles
    int n = mesh.vertex_count();
    const auto middle_of = [&](int a, int b) {
        const auto [entry, is_new] = midpoint.try_emplace(std::minmax({a, b}), n);
        if (is_new) ++n;
        return entry->second;
    };
    TriangleMesh fine;
    fine.F.resize(4 * mesh.F.rows(), 3);
    for (int t = 0; t < mesh.face_count(); ++t) {
        const int a = mesh.F(t, 0), b = mesh.F(t, 1), c = mesh.F(t, 2);
        const int ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
        fine.F.middleRows<4>(4 * Eigen::Index{t}) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    fine.X.resize(n, 3);
    fine.X.topRows(mesh.X.rows()) = mesh.X;
    for (const auto& [edge, v] : midpoint) fine.X.row(v) = 0.5 * (mesh.X.row(edge.first) + mesh.X.row(edge.second));
    return fine;
}

TriangleMesh icosphere(int level, double radius) {
    require(level >= 0, "icosphere: the level is negative");
    TriangleMesh mesh = icosahedron();
    mesh.X.rowwise().normalize();
    for (int i = 0; i < level; ++i) {
        mesh = subdivide_midpoint(mesh);
        mesh.X.rowwise().normalize();
    }
    mesh.X *= radius;
    return mesh;
}

TriangleMesh ellipsoid_mesh(int level, const Vector3& half_axes) {
    TriangleMesh mesh = icosphere(level);
    mesh.X.array().rowwise() *= half_axes.transpose().array();
    return mesh;
}

TriangleMesh torus_mesh(int around, int across, double R, double r) {
    require(around >= 3 && across >= 3, "torus_mesh: fewer than three points around or across");
    TriangleMesh mesh;
    mesh.X.resize(Eigen::Index{around} * across, 3);
    mesh.F.resize(2 * mesh.X.rows(), 3);
    const auto index = [&](int i, int j) { return (i % around) * across + j % across; };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
            const double from_axis = R + r * std::cos(v);
            mesh.X.row(index(i, j)) << from_axis * std::cos(u), from_axis * std::sin(u), r * std::sin(v);
            mesh.F.middleRows<2>(Eigen::Index{2} * index(i, j)) << index(i, j), index(i + 1, j), index(i + 1, j + 1),   //
                index(i, j), index(i + 1, j + 1), index(i, j + 1);
        }
    }
    return mesh;
}

TriangleMesh grid_mesh(int nx, int ny, double width, double depth, double (*height)(double x, double y)) {
    require(nx >= 2 && ny >= 2, "grid_mesh: fewer than two points along a side");
    TriangleMesh mesh;
    mesh.X.resize(Eigen::Index{nx} * ny, 3);
    mesh.F.resize(Eigen::Index{2} * (nx - 1) * (ny - 1), 3);
    const auto index = [&](int i, int j) { return j * nx + i; };
    int t = 0;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const double x = width * i / (nx - 1), y = depth * j / (ny - 1);
            mesh.X.row(index(i, j)) << x, y, height ? height(x, y) : 0;
            if (i + 1 == nx || j + 1 == ny) continue;
            mesh.F.middleRows<2>(t) << index(i, j), index(i + 1, j), index(i + 1, j + 1),   //
                index(i, j), index(i + 1, j + 1), index(i, j + 1);
            t += 2;
        }
    }
    return mesh;
}

TriangleMesh cube_mesh(int n, double half) {
    require(n >= 1, "cube_mesh: the number of divisions is not positive");
    const BlockSurface surface = surface_of_blocks({{{n}, {n}, {n}}}, [](int, int, int) { return true; });
    TriangleMesh cube = triangulated(surface, [&](const BlockSurface& s, int q) {
        const auto [i, j] = s.cell[static_cast<std::size_t>(q)];
        return (2 * i + 1 < n) == (2 * j + 1 < n);   // in every quarter of a side towards its corner, so that all corners are alike
    });
    cube.X = (2 * half) * (cube.X.array() - 0.5);
    return cube;
}

}   // namespace meshfolio
