/// @file
/// Meshes for the tests of spectra, stability and smoothing, and how far they are apart.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "geometry/operator_test_meshes.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/spectrum/stability.h"
#include "mesh/io/mesh_files.h"
#include "shared_meshes.h"

namespace meshfolio::testing {

/// λ_crit [length²]: the longest step for which explicit smoothing does not blow up.
inline double critical_step(const TriangleMesh& mesh) { return largest_stable_step(largest_eigenvalue(laplace_beltrami(mesh))); }

/// Both meshes as one, without a common vertex.
inline TriangleMesh side_by_side(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both{Positions(a.vertex_count() + b.vertex_count(), 3), Faces(a.face_count() + b.face_count(), 3)};
    both.X << a.X, b.X;
    both.F << a.F, (b.F.array() + a.vertex_count()).matrix();
    return both;
}

inline double largest_difference(const Positions& a, const Positions& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// One more vertex, first in order, that no triangle uses.
inline TriangleMesh with_unreferenced_vertex(const TriangleMesh& mesh, const Vector3& where) {
    TriangleMesh more{Positions(mesh.vertex_count() + 1, 3), mesh.F.array() + 1};
    more.X << where.transpose(), mesh.X;
    return more;
}

inline TriangleMesh moved_by(const TriangleMesh& mesh, const Vector3& offset) { return {mesh.X.rowwise() + offset.transpose(), mesh.F}; }

/// A closed surface without symmetry: no two eigenvalues are equal.
inline TriangleMesh lopsided_ellipsoid(int level) {
    TriangleMesh mesh = irregular_sphere(level);
    mesh.X.col(0) *= 1.7;
    mesh.X.col(1) *= 1.2;
    mesh.X.col(2) += 0.2 * mesh.X.col(0).cwiseAbs2();
    return mesh;
}

/// A flat torus of n × n squares of side 1; its cotangent operator is the five-point stencil, so the spectrum is known exactly.
inline LaplaceBeltrami flat_torus_operator(int nx, int ny, double diagonal) {
    const FlatTorus torus = flat_torus(nx, ny, diagonal);
    const double height = std::sqrt(1 - std::pow(1 - diagonal * diagonal / 2, 2));   // of the parallelogram
    return {cotangent_stiffness(torus.F, torus.vertex_count, corner_cotangents(torus.lengths)), Vector::Constant(nx * ny, height)};
}

inline std::filesystem::path shared_mesh(const std::string& name) { return testing_tools::shared_mesh_folder() / name; }

}   // namespace meshfolio::testing

/// The mesh of that name among the shared ones; leaves the test with a visible skip where they are absent.
#define SHARED_MESH_OR_SKIP(mesh, name)                                                          \
    if (!std::filesystem::exists(meshfolio::testing::shared_mesh(name))) GTEST_SKIP() << (name); \
    const TriangleMesh mesh = read_mesh(meshfolio::testing::shared_mesh(name)).mesh
