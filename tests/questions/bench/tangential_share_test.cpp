#include "questions/bench/one_ring.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/bench/bench_mesh.h"

namespace meshfolio {
namespace {

Vector shares_of(const TriangleMesh& mesh) { return tangential_shares(mesh, topology_of(mesh)); }

TriangleMesh jittered_ball() {
    TriangleMesh ball = icosphere(2);
    ball.X = jittered(ball, topology_of(ball), 0.2, 1, [](const Vector3& p) { return p.normalized(); });
    return ball;
}

/// A tip over a regular polygon: Δx points along the axis.
TriangleMesh cone(int sides) {
    TriangleMesh mesh;
    mesh.X.resize(sides + 1, 3);
    mesh.F.resize(sides, 3);
    mesh.X.row(0) << 0, 0, 0.7;
    for (int i = 0; i < sides; ++i) {
        mesh.X.row(i + 1) << std::cos(2 * M_PI * i / sides), std::sin(2 * M_PI * i / sides), 0;
        mesh.F.row(i) << 0, i + 1, (i + 1) % sides + 1;
    }
    return mesh;
}

TEST(TangentialShare, IsZeroOnSymmetricRings) {
    for (const int sides : {3, 5, 6, 9}) EXPECT_NEAR(shares_of(cone(sides))[0], 0, 1e-12) << sides;
    for (const double share : shares_of(grid_mesh(7, 5, 2, 1)))
        if (std::isfinite(share)) {
            EXPECT_EQ(share, 0);   // flat: nothing drifts
        }
}

TEST(TangentialShare, IsOneOnUnevenFlatRings) {
    TriangleMesh sheet = grid_mesh(7, 5, 2, 1);
    sheet.X = jittered(sheet, topology_of(sheet), 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    const MeshTopology topology = topology_of(sheet);
    const Vector shares = tangential_shares(sheet, topology);
    for (int i = 0; i < shares.size(); ++i) {
        if (topology.on_boundary[static_cast<std::size_t>(i)]) {
            EXPECT_TRUE(std::isnan(shares[i]));
        } else {
            EXPECT_EQ(shares[i], 1);
        }
    }
}

TEST(TangentialShare, DoesNotDependOnPlaceRotationOrUnit) {
    const TriangleMesh ball = jittered_ball();
    TriangleMesh moved = ball;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
    moved.X = ((7 * ball.X * turn.transpose()).array() + 100).matrix().eval();
    const Vector shares = shares_of(ball);
    EXPECT_LT((shares_of(moved) - shares).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GT(shares.maxCoeff(), 0.8);
    EXPECT_LT(shares.minCoeff(), 0.1);
}

// The area vectors around the tip add up to that of the outline, so the normal is the axis whatever the outline in its plane.
TEST(TangentialShare, FollowsFromTheOffsetOfTheMean) {
    TriangleMesh tip = cone(4);
    tip.X.row(1) << 1.8, 0, 0;
    const double aside = (1.8 - 1) / 4, below = 0.7;
    EXPECT_NEAR(shares_of(tip)[0], aside * aside / (aside * aside + below * below), 1e-12);
}

}   // namespace
}   // namespace meshfolio
