#include "mesh/edge_flips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/errors.h"
#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

using namespace meshfolio;

namespace {

/// A flat grid with random displacements of the inner points.
TriangleMesh shaken_grid() {
    TriangleMesh mesh = grid_mesh(20, 20, 19, 19);
    const MeshTopology topology = topology_of(mesh);
    NormalNumbers random(3);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vector3 step(0.7 * random.uniform() - 0.35, 0.7 * random.uniform() - 0.35, 0);
        if (!topology.on_boundary[static_cast<std::size_t>(v)]) mesh.X.row(v) += step;
    }
    return mesh;
}

/// Returns the smallest sum of the two cotangents opposite an inner edge; Delaunay: not negative.
double worst_cotangent_sum(const TriangleMesh& mesh) {
    const CornerValues angles = corner_angles(mesh);
    std::map<std::pair<int, int>, double> first;
    double worst = 1e9;
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const double cotangent = 1 / std::tan(angles(t, k));
            const auto [other, is_new] = first.try_emplace(std::minmax(mesh.F(t, (k + 1) % 3), mesh.F(t, (k + 2) % 3)), cotangent);
            if (!is_new) worst = std::min(worst, other->second + cotangent);
        }
    }
    return worst;
}

}   // namespace

TEST(DelaunayFlipped, MakesAPlanarMeshDelaunayOverTheSameVertices) {
    const TriangleMesh mesh = shaken_grid();
    ASSERT_LT(worst_cotangent_sum(mesh), -0.1);
    ASSERT_GT(face_normals(mesh).col(2).minCoeff(), 0);
    TriangleMesh flipped = mesh;
    flipped.F = delaunay_flipped(mesh, 100);
    EXPECT_GT(worst_cotangent_sum(flipped), -1e-5);
    EXPECT_EQ(flipped.face_count(), mesh.face_count());
    EXPECT_NEAR(surface_area(flipped), 19 * 19, 1e-10);
    EXPECT_GT(face_normals(flipped).col(2).minCoeff(), 0);
    EXPECT_EQ(topology_of(flipped).edges.size(), topology_of(mesh).edges.size());
    EXPECT_EQ(topology_of(flipped).boundary_edge_count(), topology_of(mesh).boundary_edge_count());
    EXPECT_EQ(topology_of(flipped).nonmanifold_vertex_count(), 0);
}

TEST(DelaunayFlipped, LeavesTiesAndCreasesAlone) {
    EXPECT_EQ(delaunay_flipped(cube_mesh(1)), cube_mesh(1).F);   // the diagonals of a square are equally good
    EXPECT_EQ(delaunay_flipped(cube_mesh(6)), cube_mesh(6).F);
    // Two long triangles back to back over a right angle: the crease is not Delaunay, and stays.
    TriangleMesh roof;
    roof.X.resize(4, 3);
    roof.X << -3, 0, 0, 3, 0, 0, 0, 0.5, 0, 0, 0, 0.5;
    roof.F.resize(2, 3);
    roof.F << 0, 1, 2, 1, 0, 3;
    ASSERT_LT(worst_cotangent_sum(roof), -0.1);
    EXPECT_EQ(delaunay_flipped(roof), roof.F);
}

TEST(DelaunayFlipped, RefusesAnEdgeOfThreeTriangles) {
    TriangleMesh fan;
    fan.X = Positions::Random(5, 3);
    fan.F.resize(3, 3);
    fan.F << 0, 1, 2, 0, 1, 3, 0, 1, 4;
    EXPECT_THROW(delaunay_flipped(fan), MeshError);
}

TEST(StepsToRingCentroids, VanishOnARegularMeshAndOnTheBoundary) {
    const TriangleMesh regular = grid_mesh(6, 6, 5, 5);
    EXPECT_LT(steps_to_ring_centroids(regular).cwiseAbs().maxCoeff(), 1e-14);
    const TriangleMesh shaken = shaken_grid();
    const Positions steps = steps_to_ring_centroids(shaken);
    const MeshTopology topology = topology_of(shaken);
    for (int v = 0; v < shaken.vertex_count(); ++v) {
        const bool on_boundary = topology.on_boundary[static_cast<std::size_t>(v)];
        if (on_boundary) {
            EXPECT_EQ(steps.row(v).norm(), 0);
        }
    }
    EXPECT_GT(steps.norm(), 1);
}
