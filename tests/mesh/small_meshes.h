/// @file
/// Small meshes with known properties, and ways to move them.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio::testing {

inline TriangleMesh mesh_of(const std::vector<std::array<double, 3>>& points, const std::vector<std::array<int, 3>>& triangles) {
    TriangleMesh mesh;
    mesh.X.resize(static_cast<Eigen::Index>(points.size()), 3);
    mesh.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) {
        for (int k = 0; k < 3; ++k) mesh.X(v, k) = points[static_cast<std::size_t>(v)][static_cast<std::size_t>(k)];
    }
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) mesh.F(t, k) = triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
    }
    return mesh;
}

/// Returns the corner of the unit cube, cut off. Area (3 + √3) / 2, volume 1/6.
inline TriangleMesh tetrahedron() {
    return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// Returns a cube of edge 1, 8 vertices, normals out.
inline TriangleMesh unit_cube() {
    TriangleMesh cube = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {{0, 2, 1},
                                                                                                                           {0, 3, 2},
                                                                                                                           {4, 5, 6},
                                                                                                                           {4, 6, 7},
                                                                                                                           {0, 1, 5},
                                                                                                                           {0, 5, 4},
                                                                                                                           {1, 2, 6},
                                                                                                                           {1, 6, 5},
                                                                                                                           {2, 3, 7},
                                                                                                                           {2, 7, 6},
                                                                                                                           {3, 0, 4},
                                                                                                                           {3, 4, 7}});
    return cube;
}

/// Returns the triangles of rows × columns vertices, each quad cut in two, closed around in the directions that wrap. Vertex (i, j) is row
/// i·columns + j.
inline Faces grid_faces(int rows, int columns, bool wrap_rows, bool wrap_columns) {
    std::vector<std::array<int, 3>> triangles;
    const auto vertex = [&](int i, int j) { return i % rows * columns + j % columns; };
    for (int i = 0; i < rows - (wrap_rows ? 0 : 1); ++i) {
        for (int j = 0; j < columns - (wrap_columns ? 0 : 1); ++j) {
            triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    }
    return mesh_of({}, triangles).F;
}

/// Returns a torus of radii R and r, normals out.
inline TriangleMesh torus(int around, int across, double R = 2, double r = 0.5) {
    TriangleMesh mesh;
    mesh.X.resize(around * across, 3);
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            mesh.X.row(i * across + j) << (R + r * std::cos(v)) * std::cos(u), (R + r * std::cos(v)) * std::sin(u), r * std::sin(v);
        }
    }
    mesh.F = grid_faces(around, across, true, true);
    return mesh;
}

/// Returns flat rows × columns vertices one unit apart, normals +z.
inline TriangleMesh flat_grid(int rows, int columns) {
    TriangleMesh mesh;
    mesh.X.resize(rows * columns, 3);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) mesh.X.row(i * columns + j) << i, j, 0;
    }
    mesh.F = grid_faces(rows, columns, false, false);
    return mesh;
}

/// Returns a strip of n quads with a half turn: one boundary, no consistent orientation.
inline TriangleMesh moebius_strip(int n) {
    TriangleMesh mesh;
    mesh.X.resize(2 * n, 3);
    std::vector<std::array<int, 3>> triangles;
    for (int i = 0; i < n; ++i) {
        const double u = 2 * std::numbers::pi * i / n;
        for (int side = 0; side < 2; ++side) {
            const double w = side == 0 ? -0.3 : 0.3;
            const double radius = 1 + w * std::cos(u / 2);
            mesh.X.row(2 * i + side) << radius * std::cos(u), radius * std::sin(u), w * std::sin(u / 2);
        }
        const int a = 2 * i;
        const int b = 2 * i + 1;
        const int c = i + 1 < n ? a + 2 : 1;   // the last quad meets the first one turned over
        const int d = i + 1 < n ? b + 2 : 0;
        triangles.push_back({a, c, d});
        triangles.push_back({a, d, b});
    }
    mesh.F = mesh_of({}, triangles).F;
    return mesh;
}

/// Returns two meshes as one, the vertices of a before those of b.
inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both;
    both.X.resize(a.X.rows() + b.X.rows(), 3);
    both.X << a.X, b.X;
    both.F.resize(a.F.rows() + b.F.rows(), 3);
    both.F << a.F, (b.F.array() + a.vertex_count()).matrix();
    return both;
}

inline Positions moved(const Positions& X, const Vector3& shift, double scale = 1) {
    return ((scale * X).rowwise() + shift.transpose()).eval();
}

inline Positions rotated(const Positions& X) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    return X * R.transpose();
}

}   // namespace meshfolio::testing
