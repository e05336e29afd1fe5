#include "geometry/operators/intrinsic_delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/operators/laplace_operator.h"
#include "geometry/operators/triangle_shape.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

TriangleShape shape_of(const IntrinsicTriangles& triangles, Eigen::Index t) {
    return triangle_shape(triangles.lengths(t, 0), triangles.lengths(t, 1), triangles.lengths(t, 2));
}

double area_of(const IntrinsicTriangles& triangles) {
    double area = 0;
    for (Eigen::Index t = 0; t < triangles.F.rows(); ++t) area += shape_of(triangles, t).area();
    return area;
}

Vector angle_sums(const IntrinsicTriangles& triangles) {
    Vector sums = Vector::Zero(triangles.vertex_count);
    for (Eigen::Index t = 0; t < triangles.F.rows(); ++t) {
        const TriangleShape shape = shape_of(triangles, t);
        for (int k = 0; k < 3; ++k) sums[triangles.F(t, k)] += std::atan2(shape.cross, shape.dot[static_cast<std::size_t>(k)]);
    }
    return sums;
}

/// Glued sides name each other, have one length, and run between the same vertices in opposite directions.
void expect_well_glued(const IntrinsicTriangles& triangles) {
    for (int side = 0; side < 3 * triangles.F.rows(); ++side) {
        const int other = triangles.glued_to[static_cast<std::size_t>(side)];
        if (other == IntrinsicTriangles::not_glued) continue;
        ASSERT_EQ(triangles.glued_to[static_cast<std::size_t>(other)], side);
        ASSERT_EQ(triangles.lengths(side / 3, side % 3), triangles.lengths(other / 3, other % 3));
        ASSERT_EQ(triangles.F(side / 3, (side + 1) % 3), triangles.F(other / 3, (other % 3 + 2) % 3));
        ASSERT_EQ(triangles.F(side / 3, (side % 3 + 2) % 3), triangles.F(other / 3, (other % 3 + 1) % 3));
    }
}

TriangleMesh stretched_cylinder() {
    TriangleMesh mesh = irregular_plane(12);
    const Positions flat = mesh.X;
    for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) mesh.X.row(i) << std::cos(3 * flat(i, 0)), std::sin(3 * flat(i, 0)), 7 * flat(i, 1);
    return mesh;
}

std::vector<TriangleMesh> irregular_meshes() {
    TriangleMesh needles = irregular_sphere(3);
    needles.X.col(2) *= 30;
    return {irregular_sphere(3),       irregular_plane(9),   lopsided_ellipsoid(3), stretched_cylinder(), needles,
            torus_mesh(40, 4, 2, 0.3), random_sphere(400, 5)};
}

}   // namespace

TEST(IntrinsicDelaunay, FlipsMakeEveryGluedEdgeDelaunay) {
    for (const TriangleMesh& mesh : irregular_meshes()) {
        const IntrinsicTriangles before = intrinsic_triangles(mesh);
        const IntrinsicDelaunay after = intrinsic_delaunay(before);
        EXPECT_GE(smallest_cotangent_sum(after.triangles), -1e-7);
        EXPECT_EQ(after.flips > 0, smallest_cotangent_sum(before) < -1e-7);
        EXPECT_EQ(intrinsic_delaunay(after.triangles).flips, 0) << "nothing is left to do";
        expect_well_glued(after.triangles);
    }
}

// Intrinsic measures of the surface do not depend on the edges drawn over it.
TEST(IntrinsicDelaunay, TheSurfaceIsUnchanged) {
    for (const TriangleMesh& mesh : irregular_meshes()) {
        const IntrinsicTriangles before = intrinsic_triangles(mesh);
        const IntrinsicDelaunay after = intrinsic_delaunay(before);
        EXPECT_NEAR(area_of(after.triangles) / area_of(before), 1, 1e-12);
        EXPECT_LT((angle_sums(after.triangles) - angle_sums(before)).cwiseAbs().maxCoeff(), 1e-9);
        const auto open = [](const IntrinsicTriangles& t) {
            return std::count(t.glued_to.begin(), t.glued_to.end(), IntrinsicTriangles::not_glued);
        };
        EXPECT_EQ(open(after.triangles), open(before)) << "boundary edges stay";
    }
}

// Points in a plane have one Delaunay triangulation, and linear functions are harmonic on any.
TEST(IntrinsicDelaunay, PlaneKeepsLinearPrecisionAndLosesNegativeWeights) {
    TriangleMesh mesh = irregular_plane(20, 0.25);   // no triangle is turned over, so that the surface is flat
    mesh.X.col(0) *= 4;
    const MeshTopology topology = topology_of(mesh);
    const SparseMatrix before = laplace_operator(mesh, OperatorKind::cotan).C, C = laplace_operator(mesh, OperatorKind::idt).C;
    const Positions CX = C * mesh.X;
    double smallest_before = 0, smallest = 0, precision = 0;
    for (int j = 0; j < mesh.vertex_count(); ++j) {
        const bool inside = topology.on_boundary[static_cast<std::size_t>(j)] == 0;
        if (inside) precision = std::max(precision, CX.row(j).norm());
        for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry) {
            if (inside && entry.row() != j) smallest = std::min(smallest, entry.value());
        }
        for (SparseMatrix::InnerIterator entry(before, j); entry; ++entry) {
            if (inside && entry.row() != j) smallest_before = std::min(smallest_before, entry.value());
        }
    }
    EXPECT_LT(precision, 1e-12);
    EXPECT_LT(smallest_before, -0.01);
    EXPECT_GE(smallest, -1e-9);
}

// Rippa 1990: of all triangulations the Delaunay one has the least Dirichlet energy, whatever the function.
TEST(IntrinsicDelaunay, DirichletEnergyNeverRises) {
    NormalNumbers random(17);
    for (const TriangleMesh& mesh : irregular_meshes()) {
        const SparseMatrix before = laplace_operator(mesh, OperatorKind::cotan).C, after = laplace_operator(mesh, OperatorKind::idt).C;
        for (int trial = 0; trial < 20; ++trial) {
            Vector f(mesh.vertex_count());
            for (double& value : f) value = 2 * random.uniform() - 1;
            EXPECT_LE(-f.dot(after * f), -f.dot(before * f) * (1 + 1e-12));
        }
    }
}

TEST(IntrinsicDelaunay, IgnoresPlaceScaleAndOrderOfVertices) {
    for (const TriangleMesh& mesh : irregular_meshes()) {
        const SparseMatrix C = laplace_operator(mesh, OperatorKind::idt).C;
        const double size = C.norm();
        EXPECT_LT((laplace_operator(rotated_and_moved(mesh), OperatorKind::idt).C - C).norm(), 1e-8 * size);
        for (const double s : {1e-30, 1e-3, 1e30}) {
            const LaplaceBeltrami other = laplace_operator(scaled(mesh, s), OperatorKind::idt);
            EXPECT_LT((other.C - C).norm(), 1e-8 * size) << s;
        }
        const Renamed renamed = with_shuffled_vertices(mesh);
        const DenseMatrix D(laplace_operator(renamed.mesh, OperatorKind::idt).C);
        EXPECT_LT((D(renamed.name, renamed.name) - DenseMatrix(C)).norm(), 1e-8 * size);
    }
}

// A flat torus of needles: the shear is undone, back to squares, through edges that join a vertex to itself.
TEST(IntrinsicDelaunay, ShearedTorusOfOneVertexComesBackToTheSquare) {
    IntrinsicTriangles torus{Faces::Zero(2, 3), CornerValues(2, 3), {3, 4, 5, 0, 1, 2}, 1};
    const int shear = 7;   // sides (1, 0), (shear, 1) and their difference
    torus.lengths.row(0) << std::hypot(shear - 1, 1), std::hypot(shear, 1), 1;
    torus.lengths.row(1) = torus.lengths.row(0);
    const IntrinsicDelaunay delaunay = intrinsic_delaunay(torus);
    EXPECT_GE(delaunay.flips, shear - 2);
    EXPECT_NEAR(area_of(delaunay.triangles), 1, 1e-12);
    std::array<double, 3> sides{delaunay.triangles.lengths(0, 0), delaunay.triangles.lengths(0, 1), delaunay.triangles.lengths(0, 2)};
    std::sort(sides.begin(), sides.end());
    EXPECT_NEAR(sides[0], 1, 1e-12);
    EXPECT_NEAR(sides[1], 1, 1e-12);
    EXPECT_NEAR(sides[2], std::sqrt(2.0), 1e-12);
}

TEST(IntrinsicDelaunay, DiagonalOfAKiteIsKnown) {
    TriangleMesh kite{Positions(4, 3), Faces(2, 3)};
    kite.X << -3, 0, 0, 3, 0, 0, 0, 1, 0, 0, -0.5, 0;
    kite.F << 0, 1, 2, 1, 0, 3;
    const IntrinsicDelaunay delaunay = intrinsic_delaunay(intrinsic_triangles(kite));
    EXPECT_EQ(delaunay.flips, 1);
    EXPECT_NEAR(delaunay.triangles.lengths.minCoeff(), 1.5, 1e-13);
    EXPECT_GT(smallest_cotangent_sum(delaunay.triangles), 0);
}

TEST(IntrinsicDelaunay, NonManifoldAndDisagreeingEdgesAreLeftAlone) {
    TriangleMesh book{Positions(5, 3), Faces(3, 3)};
    book.X << 0, 0, 0, 1, 0, 0, 0.5, 0.05, 0, 0.5, -0.05, 0, 0.5, 0, 0.05;
    book.F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
    EXPECT_EQ(intrinsic_delaunay(intrinsic_triangles(book)).flips, 0);
    const TriangleMesh two{book.X, book.F.topRows(2)};
    EXPECT_EQ(intrinsic_delaunay(intrinsic_triangles(two)).flips, 1);
    const TriangleMesh disagreeing{book.X, (Faces(2, 3) << 0, 1, 2, 0, 1, 3).finished()};
    EXPECT_EQ(intrinsic_delaunay(intrinsic_triangles(disagreeing)).flips, 0);
}

TEST(IntrinsicDelaunay, TrianglesWithoutAreaEnd) {
    TriangleMesh mesh = irregular_sphere(2);
    for (int t = 0; t < mesh.face_count(); t += 7) mesh.X.row(mesh.F(t, 0)) = 0.5 * (mesh.X.row(mesh.F(t, 1)) + mesh.X.row(mesh.F(t, 2)));
    const IntrinsicDelaunay delaunay = intrinsic_delaunay(intrinsic_triangles(mesh));
    expect_well_glued(delaunay.triangles);
    EXPECT_TRUE(delaunay.triangles.lengths.allFinite());
}
