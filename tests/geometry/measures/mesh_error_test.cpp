#include "geometry/measures/mesh_error.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/errors.h"
#include "geometry/measures/closest_point.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/smoothing/dirichlet_energy.h"

namespace meshfolio {
namespace {

using namespace testing;

TEST(MeshError, IsZeroBetweenEqualMeshes) {
    const TriangleMesh mesh = irregular_sphere(2);
    const MeshDifference same = compare_meshes(mesh, mesh);
    EXPECT_EQ(same.rms, 0);
    EXPECT_EQ(same.max, 0);
    EXPECT_EQ(same.area_weighted_rms, 0);
    EXPECT_LT(same.mean_normal_angle, 1e-15);
    EXPECT_EQ(same.volume_ratio, 1);
    EXPECT_EQ(same.area_ratio, 1);
    EXPECT_EQ(same.inverted_faces, 0);
    EXPECT_NEAR(same.box_diagonal, 2 * std::sqrt(3.0), 0.1);
}

TEST(MeshError, OfATranslation) {
    const TriangleMesh plane = irregular_plane(8);
    TriangleMesh lifted = plane;
    lifted.X.rowwise() += Eigen::RowVector3d(0, 0, 0.25);
    const MeshDifference up = compare_meshes(plane, lifted);
    for (const double distance : {up.rms, up.max, up.area_weighted_rms}) EXPECT_NEAR(distance, 0.25, 1e-15);
    EXPECT_TRUE(std::isnan(up.volume_ratio));
    TriangleMesh shifted = plane;   // by 3-4-5 within its plane: the corner (1, 1) is farthest from the other square
    shifted.X.rowwise() += Eigen::RowVector3d(0.03, 0.04, 0);
    const MeshDifference aside = compare_meshes(plane, shifted);
    for (const double distance : {aside.rms, aside.max}) EXPECT_NEAR(distance, 0.05, 1e-15);
    EXPECT_NEAR(aside.mean_normal_angle, 0, 1e-15);
}

TEST(MeshError, OfAScaledCube) {
    const TriangleMesh cube = cube_mesh(1);   // half-edge ½: corners at distance √3/2
    const MeshDifference doubled = compare_meshes(cube, scaled(cube, 2));
    EXPECT_NEAR(doubled.rms, std::sqrt(3.0) / 2, 1e-15);
    EXPECT_NEAR(doubled.max, std::sqrt(3.0) / 2, 1e-15);
    EXPECT_NEAR(doubled.volume_ratio, 8, 1e-14);
    EXPECT_NEAR(doubled.area_ratio, 4, 1e-14);
    EXPECT_NEAR(compare_meshes(scaled(cube, 2), cube).volume_ratio, 1.0 / 8, 1e-15);
}

TEST(MeshError, RmsAndMaxOfOneMovedVertex) {
    const TriangleMesh mesh = fan(6);
    TriangleMesh moved = mesh;
    moved.X(0, 2) = 3;
    const MeshDifference difference = compare_meshes(mesh, moved);
    EXPECT_NEAR(difference.rms, 3 / std::sqrt(7.0), 1e-15);
    EXPECT_NEAR(difference.max, 3, 1e-15);
    EXPECT_NEAR(difference.area_weighted_rms, 3 / std::sqrt(3.0), 1e-15);   // the middle has a third of the area
    const double angle = std::atan(3 / std::cos(pi / 6));
    EXPECT_NEAR(difference.mean_normal_angle, angle, 1e-14);
    EXPECT_NEAR(difference.mean_squared_normal_angle, angle * angle, 1e-14);
}

TEST(MeshError, NormalsOfARotation) {
    const TriangleMesh plane = irregular_plane(5);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vector3::UnitX()).toRotationMatrix();
    const MeshDifference turned = compare_meshes(plane, {plane.X * turn.transpose(), plane.F});
    EXPECT_NEAR(turned.mean_normal_angle, 0.3, 1e-14);
    EXPECT_NEAR(turned.mean_squared_normal_angle, 0.09, 1e-14);
    EXPECT_EQ(turned.inverted_faces, 0);
    TriangleMesh mirrored = plane;
    mirrored.X.col(0) *= -1;
    EXPECT_EQ(compare_meshes(plane, mirrored).inverted_faces, plane.face_count());
    EXPECT_NEAR(compare_meshes(plane, mirrored).mean_normal_angle, pi, 1e-14);
}

TEST(MeshError, FollowsMotionAndScale) {
    const TriangleMesh a = irregular_sphere(2);
    const TriangleMesh b{with_gaussian_noise(a.X, Vector3(0.05, 0.1, 0.02), 5), a.F};
    const MeshDifference plain = compare_meshes(a, b);
    const MeshDifference moved = compare_meshes(rotated_and_moved(a), rotated_and_moved(b));
    EXPECT_NEAR(moved.rms, plain.rms, 1e-13);
    EXPECT_NEAR(moved.mean_normal_angle, plain.mean_normal_angle, 1e-12);
    for (const double s : {7.0, 1e30, 1e-30, 1e90}) {
        const MeshDifference rescaled = compare_meshes(scaled(a, s), scaled(b, s));
        EXPECT_NEAR(rescaled.rms / s, plain.rms, 1e-14) << s;
        EXPECT_NEAR(rescaled.max / s, plain.max, 1e-14) << s;
        EXPECT_NEAR(rescaled.area_weighted_rms / s, plain.area_weighted_rms, 1e-14) << s;
    }
}

TEST(MeshError, RefusesMeshesWithOtherTriangles) {
    const TriangleMesh a = fan(6);
    TriangleMesh other = a;
    other.F.row(2).reverseInPlace();
    EXPECT_THROW(compare_meshes(a, other), MeshError);
    EXPECT_THROW(compare_meshes(a, fan(7)), MeshError);
    EXPECT_THROW(compare_meshes(a, {a.X, a.F.topRows(5)}), MeshError);
    EXPECT_THROW(vertex_rms(a.X, a.X.topRows(3)), MeshError);
}

TEST(VertexRms, OfAConstantShift) {
    const Positions a = fan(9).X;
    EXPECT_NEAR(vertex_rms(a, a.rowwise() + Eigen::RowVector3d(1, 2, -2)), 3, 1e-15);
}

TEST(SmallestAngle, OfKnownTriangles) {
    EXPECT_NEAR(smallest_angle(triangle({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0})), pi / 3, 1e-15);
    EXPECT_NEAR(smallest_angle(triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0})), std::atan(3.0 / 4), 1e-15);
    EXPECT_NEAR(smallest_angle(grid_mesh(4, 4, 1, 1)), pi / 4, 1e-15);
}

// The Dirichlet energy of the positions is the area (Pinkall & Polthier 1993), wherever the mesh lies.
TEST(DirichletEnergy, OfThePositionsIsTheArea) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(10), torus_mesh(20, 8, 2, 0.5), cube_mesh(3)}) {
        const SparseMatrix C = laplace_beltrami(mesh).C;
        EXPECT_NEAR(dirichlet_energy(C, mesh.X) / surface_area(mesh), 1, 1e-12);
        const Positions CX = C * mesh.X;
        EXPECT_NEAR(dirichlet_energy(C, mesh.X), -0.5 * mesh.X.cwiseProduct(CX).sum(), 1e-12);
        const Positions far = mesh.X.array() + 0x1p20;
        EXPECT_NEAR(dirichlet_energy(C, far) / surface_area(mesh), 1, 1e-8);
    }
}

TEST(ShapeDistances, IgnoreMotionWithinTheSurface) {
    const TriangleMesh mesh = cube_mesh(4);
    EXPECT_EQ(shape_rms(mesh, mesh.X), 0);
    Positions X = mesh.X;
    int raised = -1;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::RowVector3d x = mesh.X.row(v);
        const bool inside_top = x.z() > 0.49 && x.head<2>().cwiseAbs().maxCoeff() < 0.49;
        if (!inside_top) continue;
        raised = v;
        X.row(v) += Eigen::RowVector3d(0.05, -0.03, 0);   // within the side
    }
    EXPECT_LT(shape_distances(mesh, X).maxCoeff(), 1e-15);
    EXPECT_GT(vertex_rms(mesh.X, X), 0.01);
    X.row(raised).z() += 0.07;
    const Vector d = shape_distances(mesh, X);
    EXPECT_NEAR(d[raised], 0.07, 1e-15);
    EXPECT_NEAR(shape_rms(mesh, X), 0.07 / std::sqrt(mesh.vertex_count()), 1e-15);
    const Positions noisy = with_gaussian_noise(mesh.X, Vector3::Constant(0.1), 1);
    EXPECT_TRUE((shape_distances(mesh, noisy).array() <= (noisy - mesh.X).rowwise().norm().array()).all());
    EXPECT_NEAR(shape_rms({3 * mesh.X, mesh.F}, 3 * noisy), 3 * shape_rms(mesh, noisy), 1e-14);
    EXPECT_THROW(shape_rms(mesh, noisy.topRows(3)), MeshError);
}

TEST(ShapeDistances, AreTheLeastDistancesToTheTrianglesAround) {
    TriangleMesh mesh = icosphere(2);
    mesh.X.topRows(20).rightCols(1) *= 1e-7;   // needles
    mesh.X.row(30) = mesh.X.row(31);           // and triangles without area
    const Incidence around = triangles_around(mesh);
    for (const double amount : {1e-9, 0.1, 1.0, 1e3, 1e12}) {   // above triangles, beside sides and corners, far beyond
        const Positions X = with_gaussian_noise(mesh.X, Vector3::Constant(amount), 1);
        const Vector distances = shape_distances(mesh, X);
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            double nearest = (X.row(v) - mesh.X.row(v)).squaredNorm();
            for (const int* t = around.begin(v); t != around.end(v); ++t) {
                const auto corner = [&](int k) -> Vector3 { return mesh.X.row(mesh.F(*t, k)); };
                nearest = std::min(nearest, squared_distance_to_triangle(X.row(v), corner(0), corner(1), corner(2)));
            }
            EXPECT_NEAR(distances[v], std::sqrt(nearest), 1e-12 * (1 + amount)) << "vertex " << v << ", noise " << amount;
        }
    }
}

TEST(MeanNormalAngle, IsThatOfCompareMeshes) {
    const TriangleMesh mesh = icosphere(2);
    const TriangleMesh noisy = moved_to(mesh, with_gaussian_noise(mesh.X, Vector3::Constant(0.03), 1));
    EXPECT_NEAR(mean_normal_angle(face_normals(mesh), face_normals(noisy)), compare_meshes(mesh, noisy).mean_normal_angle, 1e-15);
    Positions a(2, 3), b(2, 3);
    a << 1, 0, 0, 0, 0, 0;
    b << 0, 1, 0, 1, 0, 0;
    EXPECT_NEAR(mean_normal_angle(a, b), M_PI / 2, 1e-15) << "a row of zeros has no direction";
    EXPECT_TRUE(std::isnan(mean_normal_angle(a, 0 * a))) << "what has shrunk to a point is no good result";
    EXPECT_TRUE(std::isnan(compare_meshes(mesh, moved_to(mesh, 0 * mesh.X)).mean_normal_angle));
    EXPECT_THROW(mean_normal_angle(a, a.topRows(1)), MeshError);
}

}   // namespace
}   // namespace meshfolio
