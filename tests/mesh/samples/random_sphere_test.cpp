#include "mesh/samples/sample_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/errors.h"
#include "mesh/mesh_topology.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;

TEST(RandomSphere, NoPointLiesOutsideATriangle) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const TriangleMesh mesh = random_sphere(300, seed);
        for (const auto& f : mesh.F.rowwise()) {
            const Vector3 a = mesh.X.row(f[0]), b = mesh.X.row(f[1]), c = mesh.X.row(f[2]);
            const Vector3 normal = (b - a).cross(c - a);
            EXPECT_GT(normal.dot(a), 0) << "looks inwards";
            EXPECT_LT((mesh.X * normal).maxCoeff() - normal.dot(a), 1e-13);
        }
    }
}

TEST(RandomSphere, IsAClosedSurfaceThroughAllPoints) {
    const TriangleMesh mesh = random_sphere(2000, 5);
    const MeshTopology topology = topology_of(mesh);
    EXPECT_EQ(mesh.face_count(), 2 * 2000 - 4);
    EXPECT_TRUE(topology.oriented_manifold);
    EXPECT_EQ(topology.boundary_edge_count(), 0);
    EXPECT_EQ(topology.edges.size(), 3u * 2000 - 6);
    for (int v = 0; v < 2000; ++v) EXPECT_GE(topology.vertex_faces.size(v), 3);
    EXPECT_LT((mesh.X.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15 * 4);
}

TEST(RandomSphere, PointsAreUniform) {
    const TriangleMesh mesh = random_sphere(20000, 9);
    EXPECT_NEAR(surface_area(mesh), 4 * M_PI, 0.02);
    const Eigen::Matrix3d moments = mesh.X.transpose() * mesh.X / 20000;   // ⅓ of the identity
    EXPECT_LT((moments - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), 0.01);
}

TEST(RandomSphere, SameSeedSameMesh) {
    EXPECT_EQ(random_sphere(100, 3).X, random_sphere(100, 3).X);
    EXPECT_EQ(random_sphere(100, 3).F, random_sphere(100, 3).F);
    EXPECT_NE(random_sphere(100, 3).X, random_sphere(100, 4).X);
    EXPECT_EQ(random_sphere(6, 1).face_count(), 8);
    EXPECT_THROW(random_sphere(5, 1), UsageError);
}
