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

TEST(CurvatureSubject, FindsPlanesAtAnyTiltAndPlace) {
    const auto normal = common_plane_normal(tilted_grid(0));
    ASSERT_TRUE(normal.has_value());
    EXPECT_NEAR(std::abs(normal->dot(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()) * Vector3::UnitZ())), 1, 1e-9);
    EXPECT_FALSE(common_plane_normal(tilted_grid(1e-3)).has_value());
    EXPECT_FALSE(common_plane_normal(icosphere(1)).has_value());
}

// Meshes that lie in a plane folded, doubled, or wound round a vertex twice.
TEST(CurvatureSubject, SheetsThatCoverAPlaneTwiceAreNotFlat) {
    TriangleMesh sheet = grid_mesh(6, 6, 1, 1);
    ASSERT_TRUE(common_plane_normal(sheet).has_value());
    TriangleMesh folded = sheet;
    folded.X.row(16) += 2.5 * (sheet.X.row(17) - sheet.X.row(16));
    EXPECT_FALSE(common_plane_normal(folded).has_value());
    TriangleMesh two_sided = sheet;
    two_sided.F.conservativeResize(2 * sheet.F.rows(), 3);
    two_sided.F.bottomRows(sheet.F.rows()) = sheet.F.rowwise().reverse();
    EXPECT_FALSE(common_plane_normal(two_sided).has_value());
    constexpr int spokes = 12;
    TriangleMesh wound;   // a fan of 12 triangles of 60°
    wound.X = Positions::Zero(spokes + 1, 3);
    wound.F.resize(spokes, 3);
    for (int i = 0; i < spokes; ++i) {
        wound.X.row(i + 1) << std::cos(i * pi / 3), std::sin(i * pi / 3), 0;
        wound.F.row(i) << 0, i + 1, (i + 1) % spokes + 1;
    }
    EXPECT_FALSE(common_plane_normal(wound).has_value());
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

TEST(CurvatureSubject, PanelRangesReportClippedValues) {
    output::Panel panel;
    panel.values = Vector(5);
    panel.values << -2, 0, 0.5, 3, std::nan("");
    EXPECT_EQ(share_beyond(panel.values, 1), 0.5);
    set_own_range(panel, 1, "K", "1/length²");
    EXPECT_EQ(panel.range->low, -1);
    EXPECT_EQ(panel.range->clipped_below, 0.25);
    EXPECT_EQ(panel.range->clipped_above, 0.25);
}

TEST(CurvatureSubject, OnATorusKIsPositiveOutsideAndNegativeInside) {
    const TriangleMesh torus = torus_mesh(48, 24, 1, 0.4);
    const CurvatureSubject subject = curvature_subject(library_mesh(torus, "signs_torus"));
    Vector K(torus.vertex_count());
    for (int i = 0; i < K.size(); ++i) K[i] = torus.X.row(i).head<2>().norm() - 1;
    const SignsByDistance seen = signs_by_distance(subject, K);
    EXPECT_EQ(seen.outer_positive, 1);
    EXPECT_GT(seen.inner_negative, 0.9);
    EXPECT_TRUE(seen.caps_outside());
    EXPECT_FALSE(signs_by_distance(subject, -K).caps_outside());
    EXPECT_FALSE(signs_by_distance(subject, Vector::Ones(K.size())).caps_outside());   // positive everywhere
}

TEST(CurvatureSubject, NamesTheCausesOfUndefinedVertices) {
    const auto undefined_words_on = [](const TriangleMesh& mesh, const char* name) {
        return undefined_words(curvature_subject(library_mesh(mesh, name)));
    };
    EXPECT_EQ(undefined_words_on(icosphere(1), "closed_ball"), "");
    TriangleMesh grid = grid_mesh(4, 4, 1, 1);
    const std::string open = undefined_words_on(grid, "open_grid");
    EXPECT_NE(open.find("12 boundary vertices"), std::string::npos) << open;
    EXPECT_EQ(open.find("manifold"), std::string::npos) << open;
    // A third triangle at an inner edge.
    const int n = grid.vertex_count(), m = grid.face_count();
    grid.X.conservativeResize(n + 1, 3);
    grid.X.row(n) << 0.5, 0.5, 1;
    grid.F.conservativeResize(m + 1, 3);
    grid.F.row(m) << 5, 6, n;
    const std::string both = undefined_words_on(grid, "fin");
    EXPECT_NE(both.find("non-manifold"), std::string::npos) << both;
    EXPECT_NE(both.find("boundary"), std::string::npos) << both;
}

TEST(CurvatureSubject, RoundedCoordinatesAreDistinguishedFromUnevenRings) {
    TriangleMesh grid = grid_mesh(9, 9, 1, 1);
    grid.X /= 3;
    EXPECT_EQ(coordinate_step(grid), 0);
    const auto largest_pull = [](const CurvatureSubject& s) {
        return largest_magnitude(0.5 * s.uniform.rowwise().norm(), [&](int i) { return s.inside(i); });
    };
    TriangleMesh rounded = grid;
    rounded.X = (1e6 * grid.X.array()).round() / 1e6;
    EXPECT_EQ(coordinate_step(rounded), 1e-6);
    const CurvatureSubject exact = curvature_subject(library_mesh(grid, "exact_grid")),
                           file = curvature_subject(library_mesh(rounded, "rounded_grid"));
    EXPECT_FALSE(exact.is_rounding(largest_pull(exact)));   // that of doubles
    EXPECT_TRUE(file.is_rounding(largest_pull(file)));
    EXPECT_FALSE(file.is_rounding(1e-3));
}

TEST(CurvatureSubject, RankCorrelationDoesNotDependOnTheScale) {
    Vector a(6), b(6);
    a << 1, 2, 3, 4, 5, std::nan("");
    b << 1, 8, 27, 64, 1e6, 0;
    EXPECT_NEAR(rank_correlation(a, b), 1, 1e-12);
    EXPECT_NEAR(rank_correlation(a, -b), -1, 1e-12);
    EXPECT_EQ(rank_correlation(a, Vector::Constant(6, 3)), 0);
    b << 2, 1, 2, 1, 2, 0;   // ties
    EXPECT_NEAR(rank_correlation(a, b), 0, 1e-12);
}

TEST(CurvatureSubject, RoughnessIgnoresOutliersAndUnits) {
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
    const output::Panel panel = unit_ball_panel(subject, "name", "label", Vector::Constant(ball.vertex_count(), 3));
    EXPECT_NEAR(panel.mesh->X.rowwise().norm().maxCoeff(), 1, 1e-12);
    EXPECT_EQ(panel.values[5], 3) << "in its own unit";
}

TEST(CurvatureSubject, OnlyCotangentIsExactOnIrregularPlanes) {
    const PlaneTest plane = irregular_plane(std::uint64_t{1});
    EXPECT_GT(plane.negative_weights, 0.01);
    EXPECT_LT(plane.cotangent, 1e-12);
    EXPECT_GT(plane.uniform, 0.01);
    EXPECT_GT(plane.clamped, 0.01);
}
