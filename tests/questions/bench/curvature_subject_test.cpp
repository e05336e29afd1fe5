#include "questions/bench/curvature_subject.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/bench/cotangent_study.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

TriangleMesh tilted_grid(double bump) {
    TriangleMesh mesh = grid_mesh(6, 6, 1, 1);
    mesh.X(14, 2) = bump;
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    mesh.X = (1e6 + (mesh.X * axes.transpose()).array()).matrix().eval();
    return mesh;
}

}   // namespace

TEST(CurvatureSubject, PlanesAreKnownAtAnyTiltAndPlace) {
    const auto normal = common_plane_normal(tilted_grid(0));
    ASSERT_TRUE(normal.has_value());
    EXPECT_NEAR(std::abs(normal->dot(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()) * Vector3::UnitZ())), 1, 1e-9);
    EXPECT_FALSE(common_plane_normal(tilted_grid(1e-3)).has_value());
    EXPECT_FALSE(common_plane_normal(icosphere(1)).has_value());
}

TEST(CurvatureSubject, SharedRangeReportsWhatEachFigureClips) {
    output::ColorRange shared;
    shared.low = -1;
    shared.high = 1;
    output::Panel panel;
    panel.values = Vector(5);
    panel.values << -2, 0, 0.5, 3, std::nan("");
    const output::ColorRange range = range_for(shared, {panel});
    EXPECT_EQ(range.low, -1);
    EXPECT_EQ(range.high, 1);
    EXPECT_EQ(range.clipped_below, 0.25);
    EXPECT_EQ(range.clipped_above, 0.25);
}

TEST(CurvatureSubject, RanksCorrelateWhateverTheScale) {
    Vector a(6), b(6);
    a << 1, 2, 3, 4, 5, std::nan("");
    b << 1, 8, 27, 64, 1e6, 0;
    EXPECT_NEAR(rank_correlation(a, b), 1, 1e-12);
    EXPECT_NEAR(rank_correlation(a, -b), -1, 1e-12);
    EXPECT_EQ(rank_correlation(a, Vector::Constant(6, 3)), 0);
    b << 2, 1, 2, 1, 2, 0;   // ties
    EXPECT_NEAR(rank_correlation(a, b), 0, 1e-12);
}

TEST(CurvatureSubject, RoughnessIsOfNineInTenAndWithoutUnit) {
    const TriangleMesh grid = grid_mesh(20, 20, 1, 1);
    const MeshTopology topology = topology_of(grid);
    Vector ramp = grid.X.col(0), checks(grid.vertex_count());
    for (int i = 0; i < checks.size(); ++i) checks[i] = i % 2 == 0 ? 1 : -1;
    EXPECT_LT(roughness(ramp, topology), 0.1);
    EXPECT_NEAR(roughness(checks, topology), 2, 1e-12);
    const double before = roughness(ramp, topology);
    ramp[37] = 1e9;   // one vertex is not what a picture shows
    EXPECT_NEAR(roughness(ramp, topology), before, 0.02);
    EXPECT_NEAR(roughness(7 * ramp, topology), roughness(ramp, topology), 1e-12);
    EXPECT_EQ(roughness(Vector::Zero(grid.vertex_count()), topology), 0);
}

TEST(CurvatureSubject, PanelsOfMeshesOfAnySizeFitIntoOneFrame) {
    TriangleMesh ball = icosphere(1, 40);
    ball.X.rowwise() += Eigen::RowVector3d(100, 0, 7);
    const CurvatureSubject subject = curvature_subject(library_mesh(ball, "far_ball"));
    const output::Panel panel = relative_panel(subject, "name", "label", Vector::Constant(ball.vertex_count(), 3), 4);
    EXPECT_NEAR(panel.mesh->X.rowwise().norm().maxCoeff(), 1, 1e-12);
    EXPECT_NEAR(panel.values[5], 75, 1e-12);
}

TEST(CurvatureSubject, CotangentIsExactOnIrregularPlanesAndOthersAreNot) {
    const PlaneTest plane = irregular_plane(std::uint64_t{1});
    EXPECT_GT(plane.negative_weights, 0.01);
    EXPECT_LT(plane.cotangent, 1e-12);
    EXPECT_GT(plane.uniform, 0.01);
    EXPECT_GT(plane.clamped, 0.01);
}
