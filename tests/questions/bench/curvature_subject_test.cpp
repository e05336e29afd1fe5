#include "questions/bench/curvature_subject.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/bench/cotangent_study.h"

using namespace meshfolio;

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

TEST(CurvatureSubject, CotangentIsExactOnIrregularPlanesAndOthersAreNot) {
    const PlaneTest plane = irregular_plane(1);
    EXPECT_GT(plane.negative_weights, 0.01);
    EXPECT_LT(plane.cotangent, 1e-12);
    EXPECT_GT(plane.uniform, 0.01);
    EXPECT_GT(plane.clamped, 0.01);
}
