#include "questions/bench/curvature_study.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/bench/cotangent_study.h"
#include "questions/bench/uniform_curvature_study.h"

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

TEST(CurvatureStudy, PlanesAreKnownAtAnyTiltAndPlace) {
    const auto normal = common_plane_normal(tilted_grid(0));
    ASSERT_TRUE(normal.has_value());
    EXPECT_NEAR(std::abs(normal->dot(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()) * Vector3::UnitZ())), 1, 1e-9);
    EXPECT_FALSE(common_plane_normal(tilted_grid(1e-3)).has_value());
    EXPECT_FALSE(common_plane_normal(icosphere(1)).has_value());
}

TEST(CurvatureStudy, WordsFollowTheNumbers) {
    EXPECT_EQ(trend({{1, 0.5, 0.25}, {0.16, 0.04, 0.01}}).substr(0, 5), "falls");
    EXPECT_EQ(trend({{1, 0.5, 0.25}, {0.01, 0.02, 0.04}}).substr(0, 5), "grows");
    EXPECT_NE(trend({{1, 0.5, 0.25}, {0.1, 0.1, 0.1}}).find("without converging"), std::string::npos);
    EXPECT_TRUE(converges({{1, 0.5}, {0.2, 0.1}}));
    EXPECT_FALSE(converges({{1, 0.5}, {0.1, 0.1}}));
    EXPECT_NE(grade(0.001), grade(0.03));
    EXPECT_NE(grade(0.03), grade(0.1));
    EXPECT_NE(grade(0.1), grade(10));
}

// The worst of each kind may lie on different surfaces: their ratio is that of no surface.
TEST(CurvatureStudy, JitterIsJudgedSurfaceBySurface) {
    std::vector<UniformRefinement> refinements;
    const auto add = [&](Triangulation triangulation, std::size_t surface, double H, double K) {
        UniformErrors errors;
        errors.H.l2 = H;
        errors.K[0].l2 = K;
        refinements.push_back({known_surfaces()[surface], triangulation, {UniformErrors{}, errors}});
    };
    add(Triangulation::regular, 0, 0.2, 0.01);
    add(Triangulation::regular, 1, 0.01, 0.5);
    add(Triangulation::jittered, 0, 0.6, 0.01);
    add(Triangulation::jittered, 1, 0.5, 0.25);
    EXPECT_DOUBLE_EQ(jitter_factors(refinements, false).least, 3);
    EXPECT_DOUBLE_EQ(jitter_factors(refinements, false).most, 50);
    EXPECT_TRUE(jitter_factors(refinements, false).matter());
    EXPECT_DOUBLE_EQ(jitter_factors(refinements, true).least, 0.5);
    EXPECT_DOUBLE_EQ(jitter_factors(refinements, true).most, 1);
    EXPECT_FALSE(jitter_factors(refinements, true).matter());
}

TEST(CurvatureStudy, SharedRangeTellsWhatEachFigureClips) {
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

TEST(CurvatureStudy, CotangentIsExactOnIrregularPlanesAndOthersAreNot) {
    const PlaneTest plane = irregular_plane(1);
    EXPECT_GT(plane.negative_weights, 0.01);
    EXPECT_LT(plane.cotangent, 1e-12);
    EXPECT_GT(plane.uniform, 0.01);
    EXPECT_GT(plane.clamped, 0.01);
}

TEST(CurvatureStudy, NormalPartOfTheUniformLaplacianIsExactAtAnyPointsOfASphere) {
    const KnownSurface sphere = known_surfaces()[0];
    const UniformErrors regular = uniform_errors(sampled(sphere, 3, Triangulation::regular, 1));
    const UniformErrors moved = uniform_errors(sampled(sphere, 3, Triangulation::jittered, 1));
    EXPECT_LT(regular.normal_part.linf, 1e-11);
    EXPECT_LT(moved.normal_part.linf, 1e-11);
    EXPECT_GT(moved.H.l2, 0.5);   // while the norm of all of Δx is useless
}

TEST(CurvatureStudy, JitterStopsTheCotangentOperatorFromConverging) {
    const KnownSurface torus = known_surfaces()[2];
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        CotangentRefinement r{torus, triangulation, {}};
        for (const int level : {3, 4, 5}) r.levels.push_back(cotangent_errors(sampled(torus, level, triangulation, 1)));
        EXPECT_EQ(converges(cotangent_H(r, 2)), triangulation == Triangulation::regular);
    }
}
