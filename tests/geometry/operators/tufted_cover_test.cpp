#include "geometry/operators/tufted_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/dense_pairs.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

double smallest_weight(const SparseMatrix& C) {
    double smallest = 0;
    for (int j = 0; j < C.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry) {
            if (entry.row() != j) smallest = std::min(smallest, entry.value());
        }
    }
    return smallest;
}

/// Three triangles around one edge.
TriangleMesh book() {
    TriangleMesh mesh{Positions(5, 3), Faces(3, 3)};
    mesh.X << 0, 0, 0, 1, 0, 0, 0.4, 0.9, 0, 0.6, -0.5, 0.8, 0.3, -0.6, -0.7;
    mesh.F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
    return mesh;
}

/// Needles, a doubled face, an edge of three triangles, a boundary, a triangle without area.
TriangleMesh everything_wrong() {
    TriangleMesh mesh{Positions(7, 3), Faces(6, 3)};
    mesh.X << 0, 0, 0, 1, 0, 0, 0.5, 1e-9, 0, 0.5, 0.4, 0.8, 0.5, -0.6, 0.1, 2, 0, 0, 0.5, -0.6, 0.1;
    mesh.F << 0, 1, 2, 0, 1, 3, 3, 1, 0, 1, 0, 4, 0, 1, 5, 4, 1, 6;
    return mesh;
}

}   // namespace

TEST(TuftedCover, IsClosedAndOriented) {
    for (const TriangleMesh& mesh : {irregular_plane(5), book(), everything_wrong(), irregular_sphere(1)}) {
        const IntrinsicTriangles cover = two_sided_cover(mesh);
        ASSERT_EQ(cover.F.rows(), 2 * mesh.F.rows());
        for (int side = 0; side < 3 * cover.F.rows(); ++side) {
            const int other = cover.glued_to[static_cast<std::size_t>(side)];
            ASSERT_NE(other, IntrinsicTriangles::not_glued);
            ASSERT_EQ(cover.glued_to[static_cast<std::size_t>(other)], side);
            EXPECT_EQ(cover.lengths(side / 3, side % 3), cover.lengths(other / 3, other % 3));
            EXPECT_EQ(cover.F(side / 3, (side % 3 + 1) % 3), cover.F(other / 3, (other % 3 + 2) % 3)) << "opposite directions";
        }
    }
}

// Around an edge of three triangles, each faces the next: the front of one is glued to the back of its neighbour by angle.
TEST(TuftedCover, GluesTheSidesThatFaceEachOther) {
    const TriangleMesh mesh = book();
    const IntrinsicTriangles cover = two_sided_cover(mesh);
    const auto glued = [&](int triangle, int corner) { return cover.glued_to[static_cast<std::size_t>(3 * triangle + corner)] / 3; };
    // About the edge from 0 to 1, angles grow from tip 2 over tip 3 to tip 4. Front 0 is (0, 1, 2), with its normal towards tip 3;
    // front 1 is (1, 0, 3), with its normal towards tip 2; backs have their last two corners exchanged.
    EXPECT_EQ(glued(0, 2), 1) << "front of 0 to front of 1";
    EXPECT_EQ(glued(3 + 1, 1), 3 + 2) << "back of 1 to back of 2";
    EXPECT_EQ(glued(2, 2), 3 + 0) << "front of 2 to back of 0";
}

TEST(TuftedCover, GluesManyPagesInTheOrderOfTheirAngles) {
    const std::vector<double> degrees = {215, 20, 300, 200, 80};
    const std::vector<int> next = {2, 4, 1, 0, 3};   // the page with the next larger angle, all the way round
    const auto pages = static_cast<int>(degrees.size());
    TriangleMesh mesh{Positions(2 + pages, 3), Faces(pages, 3)};
    mesh.X.topRows(2) << 0, 0, 0, 1, 0, 0;
    for (int i = 0; i < pages; ++i) {
        const double angle = degrees[static_cast<std::size_t>(i)] * pi / 180;
        mesh.X.row(2 + i) << 0.5, std::cos(angle), std::sin(angle);
        mesh.F.row(i) << 0, 1, 2 + i;
    }
    const IntrinsicTriangles cover = two_sided_cover(mesh);
    for (int i = 0; i < pages; ++i) {
        EXPECT_EQ(cover.glued_to[static_cast<std::size_t>(3 * i + 2)] / 3, pages + next[static_cast<std::size_t>(i)])
            << "front of " << i << " to the back of the next";
    }
}

TEST(TuftedCover, EqualsTheCotangentOperatorOnClosedDelaunayMeshes) {
    for (const TriangleMesh& mesh : {icosphere(2), torus_mesh(24, 18, 2, 1)}) {
        if (smallest_cotangent_sum(intrinsic_triangles(mesh)) < 0) continue;
        for (const AreaForm form : {AreaForm::barycentric, AreaForm::mixed}) {
            const LaplaceBeltrami cotan = laplace_beltrami(mesh, form), tufted = tufted_laplacian(mesh, form);
            EXPECT_LT((tufted.C - cotan.C).norm(), 1e-12 * cotan.C.norm());
            EXPECT_LT((tufted.M - cotan.M).norm(), 1e-12 * cotan.M.norm());
        }
    }
    EXPECT_GT(smallest_cotangent_sum(intrinsic_triangles(icosphere(2))), 0) << "at least one mesh was compared";
}

TEST(TuftedCover, EqualsIntrinsicDelaunayOnClosedManifolds) {
    const TriangleMesh mesh = irregular_sphere(3);
    const LaplaceBeltrami idt = laplace_operator(mesh, OperatorKind::idt), tufted = tufted_laplacian(mesh);
    EXPECT_LT((tufted.C - idt.C).norm(), 1e-9 * idt.C.norm());
    EXPECT_LT((tufted.M - idt.M).norm(), 1e-9 * idt.M.norm());
}

TEST(TuftedCover, WeightsAreNeverNegativeAndTheOperatorIsSemidefinite) {
    for (const TriangleMesh& mesh : {irregular_plane(8), book(), everything_wrong(), irregular_sphere(2)}) {
        const LaplaceBeltrami tufted = tufted_laplacian(mesh);
        const DenseMatrix C(tufted.C);
        const double size = C.cwiseAbs().maxCoeff();
        EXPECT_EQ((C - C.transpose()).norm(), 0);
        EXPECT_GE(smallest_weight(tufted.C), -1e-9 * size);
        EXPECT_LT((C * Vector::Ones(C.rows())).cwiseAbs().maxCoeff(), 1e-12 * size);
        EXPECT_GE(dense_pairs(-C).eigenvalues[0], -1e-12 * size);
        EXPECT_GE(tufted.M.minCoeff(), 0);
    }
}

TEST(TuftedCover, MassIsTheAreaOfTheMesh) {
    for (const TriangleMesh& mesh : {irregular_plane(8), book(), irregular_sphere(2)})
        EXPECT_NEAR(tufted_laplacian(mesh).M.sum() / vertex_areas(mesh, AreaForm::barycentric).sum(), 1, 1e-12);
}

TEST(TuftedCover, DoesNotDependOnOrientationOrOrder) {
    for (const TriangleMesh& mesh : {irregular_plane(6), book(), irregular_sphere(2)}) {
        const SparseMatrix C = tufted_laplacian(mesh).C;
        EXPECT_LT((tufted_laplacian(turned_inside_out(mesh)).C - C).norm(), 1e-9 * C.norm());
        TriangleMesh mixed = mesh;
        for (Eigen::Index t = 0; t < mixed.F.rows(); t += 2) std::swap(mixed.F(t, 0), mixed.F(t, 2));
        EXPECT_LT((tufted_laplacian(mixed).C - C).norm(), 1e-9 * C.norm()) << "orientations that disagree";
        EXPECT_LT((tufted_laplacian(rotated_and_moved(scaled(mesh, 1e-4))).C - C).norm(), 1e-8 * C.norm());
        const Renamed renamed = with_shuffled_vertices(mesh);
        const DenseMatrix D(tufted_laplacian(renamed.mesh).C);
        EXPECT_LT((D(renamed.name, renamed.name) - DenseMatrix(C)).norm(), 1e-9 * C.norm());
    }
}

TEST(TuftedCover, MollifiesOnlyWhereNeeded) {
    const auto added_to = [](const TriangleMesh& mesh) {
        IntrinsicTriangles cover = two_sided_cover(mesh);
        return mollify(cover.lengths, 1e-6);
    };
    EXPECT_EQ(added_to(irregular_plane(6)), 0);
    EXPECT_GT(added_to(everything_wrong()), 0);

    CornerValues lengths(2, 3);
    lengths << 3, 4, 5, 1, 1, 2;
    CornerValues mollified = lengths;
    const double added = mollify(mollified, 1e-3);
    EXPECT_NEAR(added, 1e-3 * lengths.mean(), 1e-15) << "the flat triangle lacks just the margin";
    EXPECT_LT((mollified.array() - lengths.array() - added).abs().maxCoeff(), 1e-15);
    EXPECT_EQ(mollify(mollified, 0), 0);
}
