#include "geometry/measures/mesh_laws.h"

#include <gtest/gtest.h>

#include "geometry/curvature/curvature.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

TriangleMesh without_face(TriangleMesh mesh, Eigen::Index t) {
    mesh.F.row(t) = mesh.F.row(mesh.F.rows() - 1).eval();
    mesh.F.conservativeResize(mesh.F.rows() - 1, 3);
    return mesh;
}

TriangleMesh with_face_reversed(TriangleMesh mesh, Eigen::Index t) {
    std::swap(mesh.F(t, 0), mesh.F(t, 1));
    return mesh;
}

SparseMatrix stiffness(const TriangleMesh& mesh) { return laplace_beltrami(mesh).C; }

}   // namespace

TEST(MeshLaws, HoldOnClosedAndOpenMeshesOfAnySizeAndPlace) {
    const TriangleMesh closed = lopsided_ellipsoid(3);
    for (const TriangleMesh& mesh : {closed, irregular_plane(12), fan(5, 0.3), scaled(closed, 1e-6), scaled(closed, 1e6),
                                     moved_by(closed, {1e3, -2e3, 5}), rotated_and_moved(closed)}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const MeshTopology topology = topology_of(mesh);
        EXPECT_EQ(asymmetry(laplacian.C), 0);
        EXPECT_LT(row_sum_error(laplacian.C), 1e-14);
        EXPECT_NEAR(energy_over_area(mesh, laplacian.C), 1, 1e-10);
        EXPECT_LT(first_variation_error(mesh, laplacian.C), 1e-10);
        EXPECT_NEAR(mass_over_area(mesh, laplacian.M), 1, 1e-12);
        EXPECT_EQ(semidefinite(negative_eigenvalues(laplacian.C)), Proof::proved);
        EXPECT_EQ(repeated_half_edges(mesh.F), 0);
        const int chi = topology.boundary_edge_count() > 0 ? 1 : 2;
        EXPECT_LT(gauss_bonnet_error(angle_deficit(mesh, topology), chi), gauss_bonnet_tolerance(mesh.face_count()));
    }
    EXPECT_LT(flux_over_area(closed), 1e-15);
    EXPECT_NEAR(flux_over_area(irregular_plane(12)), 1, 1e-12);   // open and flat: all normals are one
}

TEST(MeshLaws, OtherAreasHaveTheSameSum) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    for (const AreaForm form : {AreaForm::voronoi, AreaForm::mixed}) EXPECT_NEAR(mass_over_area(mesh, vertex_areas(mesh, form)), 1, 1e-12);
}

// A face a million times longer than high counts as without area, and yet has some by ½|u × v|.
TEST(MeshLaws, TrianglesWithoutMassAreNotCountedAsArea) {
    TriangleMesh mesh;
    mesh.X.resize(4, 3);
    mesh.X << 0, 0, 0, 1e6, 0, 0, 0, 1e-6, 0, 0, 0, 1;
    mesh.F.resize(4, 3);
    mesh.F << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    const Vector M = laplace_beltrami(mesh).M;
    EXPECT_NEAR(mass_over_area(mesh, M), 1, 1e-12);
    EXPECT_GT(std::abs(M.sum() / surface_area(mesh) - 1), 1e-8);
}

TEST(MeshLaws, ALostHalfDoublesTheEnergy) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    EXPECT_NEAR(energy_over_area(mesh, 2 * stiffness(mesh)), 2, 1e-10);
    EXPECT_GT(first_variation_error(mesh, 2 * stiffness(mesh)), 0.1);
    EXPECT_NEAR(mass_over_area(mesh, 0.5 * laplace_beltrami(mesh).M), 0.5, 1e-10);
}

// Clamped or averaged weights are another operator: symmetric with rows of sum 0, but no first variation.
TEST(MeshLaws, ClampedWeightsAreNotTheFirstVariation) {
    const TriangleMesh mesh = irregular_plane(12);
    const SparseMatrix clamped = laplace_beltrami(mesh, AreaForm::barycentric, {.clamp_negative = true}).C;
    EXPECT_LT(row_sum_error(clamped), 1e-14);
    EXPECT_GT(first_variation_error(mesh, clamped), 0.01);
    EXPECT_GT(energy_over_area(mesh, clamped), 1.0001);
}

TEST(MeshLaws, EverySingleCotangentIsSeen) {
    const TriangleMesh mesh = lopsided_ellipsoid(1);
    const CornerValues cotangents = corner_cotangents(mesh);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            CornerValues wrong = cotangents;
            wrong(t, k) *= -1;
            const SparseMatrix C = cotangent_stiffness(mesh.F, mesh.vertex_count(), wrong);
            EXPECT_GT(first_variation_error(mesh, C), 1e-4 * std::abs(cotangents(t, k))) << t << " " << k;
        }
    }
}

TEST(MeshLaws, AllSignsTurnedIsNegative) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    laplacian.C *= -1;
    EXPECT_EQ(semidefinite(negative_eigenvalues(laplacian.C)), Proof::refuted);
    EXPECT_EQ(negative_eigenvalues(laplacian.C).below, mesh.vertex_count() - 1);   // all but the constant
    EXPECT_NEAR(energy_over_area(mesh, laplacian.C), -1, 1e-10);
}

TEST(MeshLaws, OneTriangleTheWrongWayRound) {
    const TriangleMesh mesh = with_face_reversed(icosphere(2), 17);
    EXPECT_EQ(repeated_half_edges(mesh.F), 3);
    EXPECT_NEAR(flux_over_area(mesh), 2 * face_areas(mesh)[17] / surface_area(mesh), 1e-12);
    EXPECT_EQ(repeated_half_edges(turned_inside_out(icosphere(2)).F), 0);   // all of them the wrong way round agree
}

TEST(MeshLaws, OneTriangleMissing) {
    const TriangleMesh whole = icosphere(2), mesh = without_face(whole, 17);
    EXPECT_NEAR(flux_over_area(mesh), face_areas(whole)[17] / surface_area(mesh), 1e-12);
    EXPECT_NEAR(energy_over_area(whole, stiffness(mesh)), 1 - face_areas(whole)[17] / surface_area(whole), 1e-12);
    EXPECT_EQ(repeated_half_edges(mesh.F), 0);
}

TEST(MeshLaws, AMovedVertexDoesNotFitTheOperator) {
    TriangleMesh mesh = lopsided_ellipsoid(3);
    const SparseMatrix C = stiffness(mesh);
    mesh.X(100, 2) += 1e-6;
    EXPECT_GT(first_variation_error(mesh, C), 1e-8);
    EXPECT_LT(first_variation_error(mesh, stiffness(mesh)), 1e-12);
}

TEST(MeshLaws, OneSidedChangesAreSeen) {
    SparseMatrix C = stiffness(icosphere(2));
    EXPECT_EQ(asymmetry(C), 0);
    SparseMatrix::InnerIterator entry(C, 3);
    while (entry.row() == entry.col()) ++entry;
    entry.valueRef() *= 1.5;
    EXPECT_GT(asymmetry(C), 0.01);
    EXPECT_GT(row_sum_error(C), 0.01);
}

TEST(MeshLaws, GaussBonnetHoldsOnThousandsOfComponents) {
    TriangleMesh one{Positions(4, 3), Faces(4, 3)};
    one.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    one.F << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    const int copies = 3000;
    TriangleMesh mesh{Positions(4 * copies, 3), Faces(4 * copies, 3)};
    for (int c = 0; c < copies; ++c) {
        mesh.X.middleRows(4 * c, 4) = one.X.rowwise() + Eigen::RowVector3d(3.7 * c, 0, 0);
        mesh.F.middleRows(4 * c, 4) = one.F.array() + 4 * c;
    }
    EXPECT_LT(gauss_bonnet_error(angle_deficit(mesh, topology_of(mesh)), 2 * copies), gauss_bonnet_tolerance(mesh.face_count()));
}

TEST(MeshLaws, GaussBonnetSeesALostAngle) {
    const TriangleMesh mesh = torus_mesh(20, 12, 2, 0.7);
    Vector deficits = angle_deficit(mesh, topology_of(mesh));
    EXPECT_LT(gauss_bonnet_error(deficits, 0), gauss_bonnet_tolerance(mesh.face_count()));
    deficits[5] += corner_angles(mesh)(0, 0);
    EXPECT_NEAR(gauss_bonnet_error(deficits, 0), corner_angles(mesh)(0, 0) / (2 * pi), 1e-12);
    EXPECT_NEAR(gauss_bonnet_error(angle_deficit(mesh, topology_of(mesh)), 2), 2, 1e-12);
}
