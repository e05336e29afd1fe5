#include "mesh/triangle_measures.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/parallel.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;
using std::numbers::pi;

TEST(TriangleMeasures, RightTriangleOfSides3And4) {
    const TriangleMesh mesh = mesh_of({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
    EXPECT_EQ(edge_lengths(mesh), (CornerValues(1, 3) << 5, 4, 3).finished());   // opposite to corners 0, 1, 2
    EXPECT_EQ(mean_edge_length(mesh), 4);
    EXPECT_EQ(face_areas(mesh)[0], 6);
    EXPECT_DOUBLE_EQ(corner_angles(mesh)(0, 0), pi / 2);
    EXPECT_DOUBLE_EQ(corner_angles(mesh)(0, 1), std::atan2(4, 3));
    EXPECT_EQ(face_normals(mesh), (Positions(1, 3) << 0, 0, 1).finished());
}

TEST(TriangleMeasures, UnitCube) {
    const TriangleMesh cube = unit_cube();
    EXPECT_NEAR(surface_area(cube), 6, 1e-15);
    EXPECT_NEAR(signed_volume(cube), 1, 1e-15);
    EXPECT_NEAR(mean_edge_length(cube), (12 + 6 * std::sqrt(2.0)) / 18, 1e-15);
    const Positions N = vertex_normals(cube);
    for (int v = 0; v < cube.vertex_count(); ++v) EXPECT_GT(N.row(v).dot(cube.X.row(v) - Vector3(0.5, 0.5, 0.5).transpose()), 0.5);
}

TEST(TriangleMeasures, AnglesOfEveryTriangleSumToPi) {
    EXPECT_LT((corner_angles(torus(12, 8)).rowwise().sum().array() - pi).abs().maxCoeff(), 1e-14);
}

TEST(TriangleMeasures, TorusAreaAndVolumeConvergeInSecondOrder) {
    const double area = 4 * pi * pi * 2 * 0.5;
    const double volume = 2 * pi * pi * 2 * 0.25;
    const double coarse_area = std::abs(surface_area(torus(32, 16)) - area);
    const double coarse_volume = std::abs(signed_volume(torus(32, 16)) - volume);
    EXPECT_NEAR(coarse_area / std::abs(surface_area(torus(64, 32)) - area), 4, 0.2);
    EXPECT_NEAR(coarse_volume / std::abs(signed_volume(torus(64, 32)) - volume), 4, 0.2);
}

TEST(TriangleMeasures, RigidMotionChangesNothing) {
    const TriangleMesh mesh = torus(9, 7);
    const TriangleMesh other = moved_to(mesh, moved(rotated(mesh.X), {30, -20, 10}));
    EXPECT_LT((face_areas(other) - face_areas(mesh)).lpNorm<Eigen::Infinity>(), 1e-13);
    EXPECT_LT((corner_angles(other) - corner_angles(mesh)).lpNorm<Eigen::Infinity>(), 1e-13);
    EXPECT_LT((face_normals(other) - rotated(face_normals(mesh))).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LT((vertex_normals(other) - rotated(vertex_normals(mesh))).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_NEAR(signed_volume(other), signed_volume(mesh), 1e-12);
}

TEST(TriangleMeasures, ScaleByItsPowerEvenAtTheEndsOfTheRange) {
    const TriangleMesh mesh = torus(9, 7);
    for (const double s : {0x1p-200, 0x1p330}) {   // squared areas would leave the range of a double
        const TriangleMesh other = moved_to(mesh, moved(mesh.X, Vector3::Zero(), s));
        EXPECT_EQ(surface_area(other), s * s * surface_area(mesh));
        EXPECT_EQ(corner_angles(other), corner_angles(mesh));
        EXPECT_EQ(vertex_normals(other), vertex_normals(mesh));
    }
}

TEST(TriangleMeasures, VolumeTurnsItsSignWithTheOrientation) {
    TriangleMesh mesh = torus(9, 7);
    const double volume = signed_volume(mesh);
    mesh.F.col(1).swap(mesh.F.col(2));
    EXPECT_GT(volume, 0);
    EXPECT_DOUBLE_EQ(signed_volume(mesh), -volume);
}

TEST(TriangleMeasures, VolumeFarFromTheOriginKeepsItsDigits) {
    EXPECT_EQ(signed_volume(moved_to(unit_cube(), moved(unit_cube().X, {1e15, 1e15, 1e15}))), 1);
}

TEST(TriangleMeasures, DegenerateTrianglesHaveNoNormal) {
    const TriangleMesh mesh = mesh_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}});
    EXPECT_EQ(face_areas(mesh)[0], 0);
    EXPECT_EQ(face_normals(mesh).norm(), 0);
    EXPECT_EQ(vertex_normals(mesh).norm(), 0);
    EXPECT_TRUE(corner_angles(mesh).allFinite());
}

TEST(TriangleMeasures, BoxLeavesUnusedVerticesOut) {
    TriangleMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 2, -3}, {99, 99, 99}}, {{0, 1, 2}});
    EXPECT_EQ(bounding_box(mesh).low, Vector3(0, 0, -3));
    EXPECT_EQ(bounding_box(mesh).high, Vector3(1, 2, 0));
    EXPECT_EQ(bounding_box(mesh).centre(), Vector3(0.5, 1, -1.5));
    mesh.F.resize(0, 3);
    EXPECT_EQ(bounding_box(mesh).high, Vector3(99, 99, 99));
}

// All vertices in use are in one of the blocks that processors share out.
TEST(TriangleMeasures, BoxOfFewAmongManyUnusedVertices) {
    constexpr int n = 3 * block_length;
    for (const int first : {0, n / 2, n - 3}) {
        TriangleMesh mesh{Positions::Constant(n, 3, 99), Faces(1, 3)};
        mesh.X.middleRows(first, 3) << 0, 0, -3, 1, 0, 0, 0, 2, 0;
        mesh.F << first, first + 1, first + 2;
        const Box box = bounding_box(mesh);
        EXPECT_EQ(box.low, Vector3(0, 0, -3));
        EXPECT_EQ(box.high, Vector3(1, 2, 0));
    }
}
