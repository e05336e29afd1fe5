/// @file
/// Meshes and motions for the tests of the operators.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "geometry/linear/special_values.h"
#include "geometry/operators/intrinsic_delaunay.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio::testing {

/// Returns an icosphere with points moved over the sphere by up to `amount` mean edges: all angles irregular, many obtuse.
inline TriangleMesh irregular_sphere(int level, double radius = 1, double amount = 0.45, std::uint64_t seed = 7) {
    TriangleMesh mesh = icosphere(level);
    const double size = amount * mean_edge_length(mesh);
    NormalNumbers random(seed);
    for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
        for (int c = 0; c < 3; ++c) mesh.X(i, c) += size * (2 * random.uniform() - 1);
    }
    mesh.X.rowwise().normalize();
    mesh.X *= radius;
    return mesh;
}

/// The grid over [0, 1]² in the plane z = 0, its interior points moved within the plane; triangles keep their orientation.
inline TriangleMesh irregular_plane(int n, double amount = 0.45, std::uint64_t seed = 11) {
    TriangleMesh mesh = grid_mesh(n, n, 1, 1);
    NormalNumbers random(seed);
    for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
        const bool inside = mesh.X.row(i).head<2>().minCoeff() > 1e-9 && mesh.X.row(i).head<2>().maxCoeff() < 1 - 1e-9;
        for (int c = 0; c < 2 && inside; ++c) mesh.X(i, c) += amount / n * (2 * random.uniform() - 1);
    }
    return mesh;
}

inline TriangleMesh triangle(const Vector3& p0, const Vector3& p1, const Vector3& p2) {
    TriangleMesh mesh;
    mesh.X.resize(3, 3);
    mesh.X << p0.transpose(), p1.transpose(), p2.transpose();
    mesh.F.resize(1, 3);
    mesh.F << 0, 1, 2;
    return mesh;
}

/// A disk of `sides` triangles around vertex 0 at (0, 0, 0); the ring has radius 1 and height `ring_height`.
inline TriangleMesh fan(int sides, double ring_height = 0) {
    TriangleMesh mesh;
    mesh.X = Positions::Zero(sides + 1, 3);
    mesh.F.resize(sides, 3);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * pi * i / sides;
        mesh.X.row(i + 1) << std::cos(angle), std::sin(angle), ring_height;
        mesh.F.row(i) << 0, 1 + i, 1 + (i + 1) % sides;
    }
    return mesh;
}

/// The flat torus of nx × ny parallelograms with sides of length 1 at an angle, each cut along one diagonal, as glued triangles
/// with edge lengths; vertex (i, j) is i + nx·j. `diagonal`: the length of the cut, √2 for squares, 1 for 60°.
struct FlatTorus {
    Faces F;
    CornerValues lengths;
    int vertex_count;
};
inline FlatTorus flat_torus(int nx, int ny, double diagonal) {
    FlatTorus torus{Faces(2 * nx * ny, 3), CornerValues(2 * nx * ny, 3), nx * ny};
    const auto vertex = [&](int i, int j) { return i % nx + nx * (j % ny); };
    for (int j = 0, t = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i, t += 2) {
            torus.F.row(t) << vertex(i, j), vertex(i + 1, j), vertex(i, j + 1);
            torus.F.row(t + 1) << vertex(i + 1, j + 1), vertex(i, j + 1), vertex(i + 1, j);
            torus.lengths.row(t) << diagonal, 1, 1;
            torus.lengths.row(t + 1) << diagonal, 1, 1;
        }
    }
    return torus;
}

/// The smallest cot α + cot β over the glued edges, by the law of cosines and Heron's area; +∞ where there is none.
inline double smallest_cotangent_sum(const IntrinsicTriangles& triangles) {
    const auto cotangent = [&](int side) {
        const Eigen::RowVector3d l = triangles.lengths.row(side / 3) / triangles.lengths.row(side / 3).maxCoeff();
        const double a = l[side % 3], b = l[(side + 1) % 3], c = l[(side + 2) % 3];
        const double area = 0.25 * std::sqrt((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c));
        return (b * b + c * c - a * a) / (4 * area);
    };
    double smallest = std::numeric_limits<double>::infinity();
    for (int side = 0; side < static_cast<int>(triangles.glued_to.size()); ++side) {
        const int other = triangles.glued_to[static_cast<std::size_t>(side)];
        if (other > side) smallest = std::min(smallest, cotangent(side) + cotangent(other));
    }
    return smallest;
}

inline Eigen::Matrix3d some_rotation() { return Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.7).normalized()).toRotationMatrix(); }

inline TriangleMesh rotated_and_moved(const TriangleMesh& mesh) {
    return {(mesh.X * some_rotation().transpose()).rowwise() + Eigen::RowVector3d(3, -5, 2), mesh.F};
}

inline TriangleMesh scaled(const TriangleMesh& mesh, double s) { return {s * mesh.X, mesh.F}; }

inline TriangleMesh turned_inside_out(TriangleMesh mesh) {
    mesh.F.col(1).swap(mesh.F.col(2));
    return mesh;
}

/// Vertex i becomes vertex name[i].
struct Renamed {
    TriangleMesh mesh;
    std::vector<int> name;
};
inline Renamed with_shuffled_vertices(const TriangleMesh& mesh, std::uint64_t seed = 3) {
    std::vector<int> name(static_cast<std::size_t>(mesh.vertex_count()));
    std::iota(name.begin(), name.end(), 0);
    NormalNumbers random(seed);
    for (std::size_t i = name.size() - 1; i > 0; --i) {
        std::swap(name[i], name[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    }
    Renamed renamed{mesh, name};
    for (int v = 0; v < mesh.vertex_count(); ++v) renamed.mesh.X.row(name[static_cast<std::size_t>(v)]) = mesh.X.row(v);
    renamed.mesh.F = mesh.F.unaryExpr([&](int v) { return name[static_cast<std::size_t>(v)]; });
    return renamed;
}

/// The values of the shuffled mesh in the order of the original one.
inline Vector in_original_order(const Vector& values, const std::vector<int>& name) {
    Vector original(values.size());
    for (Eigen::Index v = 0; v < values.size(); ++v) original[v] = values[name[static_cast<std::size_t>(v)]];
    return original;
}

inline double largest_relative_difference(const Vector& a, const Vector& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}   // namespace meshfolio::testing
