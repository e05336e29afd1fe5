#include "mesh/samples/implicit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/mesh_topology.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;

namespace {

double unit_ball(const Vector3& p) { return p.norm() - 1; }
double twice_unit_ball(const Vector3& p) { return 2 * p.norm() - 2; }

void expect_closed_manifold(const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    EXPECT_EQ(topology.boundary_edge_count(), 0);
    EXPECT_EQ(topology.nonmanifold_edge_count(), 0);
    EXPECT_EQ(topology.nonmanifold_vertex_count(), 0);
    EXPECT_GT(signed_volume(mesh), 0);
}

const Box box{{-1.9, -1.93, -1.27}, {1.95, 1.9, 1.31}};

}   // namespace

TEST(Projected, ReachesTheSurfaceAlongTheGradient) {
    const Vector3 p(0.9, 0.5, -0.3);
    EXPECT_LT((projected(unit_ball, p, 3) - p.normalized()).norm(), 1e-12);
    EXPECT_LT((projected(twice_unit_ball, p, 3) - p.normalized()).norm(), 1e-12);
}

TEST(SurfaceNet, OfABallIsASphere) {
    const TriangleMesh net = surface_net(unit_ball, box, 0.1);
    expect_closed_manifold(net);
    EXPECT_EQ(net.vertex_count() - static_cast<int>(topology_of(net).edges.size()) + net.face_count(), 2);
    EXPECT_LT((net.X.rowwise().norm().array() - 1).abs().maxCoeff(), 0.05);
    EXPECT_NEAR(signed_volume(net), 4 * std::numbers::pi / 3, 0.05);
}

TEST(RelaxedOn, GivesGoodTrianglesOnTheSurface) {
    const TriangleMesh mesh = relaxed_on(unit_ball, surface_net(unit_ball, box, 0.1), 20);
    expect_closed_manifold(mesh);
    EXPECT_LT((mesh.X.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
    EXPECT_GT(corner_angles(mesh).minCoeff(), 25 * std::numbers::pi / 180);
}
