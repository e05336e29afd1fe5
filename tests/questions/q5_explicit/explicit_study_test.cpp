#include "questions/q5_explicit/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/linear/special_values.h"
#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q5_explicit {
using namespace testing_tools;

namespace {

ExplicitStudy explicit_study_on(const TriangleMesh& mesh, const std::string& name, std::vector<double> lambda = {}) {
    QuestionSettings settings = quick_settings();
    settings.lambda = std::move(lambda);
    return explicit_study(library_mesh(mesh, name), settings);
}

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.X = Positions{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.F = Faces{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

/// Returns the first iteration at which a vertex can blow up: modes grow by at most |1 − λμ_max| a step, all coordinates together.
int earliest_blow_up(const SmoothingSubject& subject, double lambda) {
    const double growth = std::abs(1 - lambda * subject.top.value);
    if (!(growth > 1)) return std::numeric_limits<int>::max();
    // √m_v |x_v − c| ≤ ‖X − c‖_M ≤ growth^t ‖X_0 − c‖_M
    const Vector& M = subject.laplacian.M;
    const Eigen::RowVector3d centre = bounding_box(subject.mesh()).centre().transpose();
    double whole = 0, lightest = infinity;
    for (Eigen::Index v = 0; v < M.size(); ++v) {
        if (!(M[v] > 0)) continue;
        whole += M[v] * ((subject.mesh().X.row(v) - centre) / subject.diagonal).squaredNorm();
        lightest = std::min(lightest, M[v]);
    }
    const double steps = std::log(SmoothingOptions{}.blow_up_at * std::sqrt(lightest / whole)) / std::log(growth);
    return std::max(1, static_cast<int>(std::ceil(steps * (1 - 1e-12))));
}

}   // namespace

TEST(ExplicitStudy, DefaultStepsStandOnBothSidesOfTheLimit) {
    const ExplicitStudy study = explicit_study_on(cube_mesh(4), "cube_steps");
    std::vector<double> multiples;
    for (const SmoothingRun& run : study.runs) multiples.push_back(run.lambda / study.subject.critical);
    expect_near(multiples, {0.05, 0.5, 0.95, 1.05, 2.0});
}

TEST(ExplicitStudy, AStepGivenTwiceIsRunOnce) {
    const ExplicitStudy study = explicit_study_on(icosphere(1), "ball_twice", {0.02, 0.01, 0.02});
    ASSERT_EQ(study.runs.size(), 2u);
    EXPECT_EQ(study.runs[0].lambda, 0.01);
    EXPECT_EQ(study.runs[1].lambda, 0.02);
    EXPECT_EQ(study.amplification.size(), 2u);
}

TEST(ExplicitStudy, TheLimitIsWhereTheTopModeBeginsToGrow) {
    for (const TriangleMesh& mesh : {cube_mesh(4), icosphere(2), grid_mesh(6, 5, 2, 1)}) {
        const SmoothingSubject subject = smoothing_subject(library_mesh(mesh, "limit"));
        EXPECT_LT(top_mode_amplification(subject, 0.99 * subject.critical, 20).measured, 1);
        EXPECT_GT(top_mode_amplification(subject, 1.01 * subject.critical, 20).measured, 1);
        EXPECT_NEAR(top_mode_amplification(subject, subject.critical, 20).measured, 1, 1e-6);
        EXPECT_NEAR(top_mode_amplification(subject, 1.5 * subject.critical, 3).measured, 8, 1e-6);   // |1 − 3|³
    }
}

TEST(ExplicitStudy, AStepIsStableIfTheTopModeDoesNotGrow) {
    const ExplicitStudy study = explicit_study_on(icosphere(2), "ball_stable");
    for (std::size_t i = 0; i < study.runs.size(); ++i) EXPECT_EQ(study.stable(i), study.amplification[i].measured < 1) << i;
}

TEST(ExplicitStudy, TheRecommendedStepIsTheLargestThatKeepsSigns) {
    const TriangleMesh egg = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const ExplicitStudy study = explicit_study_on(egg, "egg_best");
    ASSERT_TRUE(study.recommended);
    EXPECT_EQ(study.recommended->run, 1u);   // half the limit, exactly
    EXPECT_TRUE(keeps_signs(study.subject, study.runs[1].lambda));
    EXPECT_FALSE(keeps_signs(study.subject, 0.51 * study.subject.critical));
    const double critical = study.subject.critical;
    EXPECT_EQ(explicit_study_on(egg, "egg_b", {0.6 * critical, 0.8 * critical, 1.2 * critical}).recommended->run, 1u);
    EXPECT_FALSE(explicit_study_on(egg, "egg_c", {1.2 * critical}).recommended);
}

TEST(ExplicitStudy, TheRecommendedRunStopsBeforeAFewPercentOfTheSizeAreLost) {
    const ExplicitStudy cube = explicit_study_on(cube_mesh(12), "cube_stop");
    const SmoothingRun &stopped = cube.recommended->stopped, &all = cube.runs[cube.recommended->run];
    ASSERT_LT(stopped.iterations, all.iterations);
    EXPECT_EQ(stopped.lambda, all.lambda);
    EXPECT_GE(stopped.volume.back(), 0.95);
    EXPECT_LT(all.volume[static_cast<std::size_t>(stopped.iterations) + 1], 0.95);
    EXPECT_FALSE(explicit_study_on(tetrahedron(), "tetrahedron_stop").recommended) << "one step takes more";
}

TEST(ExplicitStudy, TheRecommendedRunHasUpToTenTimesTheIterations) {
    QuestionSettings settings = quick_settings();
    settings.iterations = {2};
    const ExplicitStudy ball = explicit_study(library_mesh(icosphere(5), "ball_on"), settings);   // a few steps are nothing on a fine ball
    EXPECT_TRUE(ball.recommended->all_kept);
    EXPECT_EQ(ball.recommended->stopped.iterations, 20);
    EXPECT_GE(ball.recommended->stopped.size.back(), 0.95);
    settings.iterations = {4};
    const ExplicitStudy cube = explicit_study(library_mesh(cube_mesh(12), "cube_on"), settings);
    EXPECT_FALSE(cube.recommended->all_kept);
    EXPECT_LT(cube.recommended->stopped.iterations, 40);
}

TEST(ExplicitStudy, FeatureEdgesAndBoundariesMoveFarthest) {
    const Recommendation cube = *explicit_study_on(cube_mesh(12), "cube_edges").recommended;
    EXPECT_GT(cube.on_features, 2) << "flat faces hardly move";
    EXPECT_EQ(cube.on_boundary, 0) << "it has none";
    const Recommendation ball = *explicit_study_on(icosphere(3), "ball_edges").recommended;
    EXPECT_EQ(ball.on_features, 0) << "it has none";
    TriangleMesh rough = grid_mesh(20, 20, 1, 1);
    for (Eigen::Index v = 0; v < rough.X.rows(); ++v) rough.X(v, 2) += 0.01 * std::sin(3.0 * static_cast<double>(v * v));
    const Recommendation sheet = *explicit_study_on(rough, "rough_sheet").recommended;
    EXPECT_GT(sheet.on_boundary, 0);
    EXPECT_LT(sheet.roughness_after, 0.8 * sheet.roughness_before);
}

// The boundary of a sheet shrinks at once; stopping for that would leave the noise.
TEST(ExplicitStudy, TheRecommendedStepRemovesTheNoiseOfASheet) {
    TriangleMesh noisy = grid_mesh(30, 30, 1, 1);
    noisy.X = with_gaussian_noise(noisy.X, Vector3(0, 0, 0.01), 1);
    const Recommendation sheet = *explicit_study_on(noisy, "noisy_sheet").recommended;
    EXPECT_FALSE(sheet.all_kept);
    EXPECT_GE(sheet.stopped.size.back(), 0.95);
    EXPECT_LT(sheet.roughness_after, 0.1 * sheet.roughness_before);
}

TEST(ExplicitStudy, StripsShowTheFirstStepBeyondTheLimitAndTheLargest) {
    const ExplicitStudy study = explicit_study_on(cube_mesh(4), "cube_strips");
    ASSERT_TRUE(study.near && study.far);
    EXPECT_EQ(study.near->run, 3u);
    EXPECT_EQ(study.near->times, (std::vector<int>{10, 20}));
    EXPECT_EQ(study.far->run, 4u);
    ASSERT_TRUE(study.far->at(5));
    EXPECT_EQ(*study.far->at(5), run_smoothing(study.subject, SmoothingScheme::explicit_euler, 2 * study.subject.critical, 5).result.X);
    EXPECT_FALSE(study.far->at(7)) << "not kept";
    const double critical = study.subject.critical;
    const ExplicitStudy one = explicit_study_on(cube_mesh(4), "cube_one", {0.1 * critical, 1.2 * critical});
    EXPECT_TRUE(one.near && !one.far);
    const ExplicitStudy stable = explicit_study_on(cube_mesh(4), "cube_stable", {0.1 * critical, 0.9 * critical});
    EXPECT_TRUE(!stable.near && !stable.far);
}

TEST(ExplicitStudy, NoRunBlowsUpBeforeTheTopModeAllows) {
    for (const TriangleMesh& mesh : {cube_mesh(4), icosphere(2), grid_mesh(6, 5, 2, 1)}) {
        const SmoothingSubject subject = smoothing_subject(library_mesh(mesh, "early"));
        for (const double limits : {1.5, 2.0, 5.0, 100.0}) {
            const SmoothingRun run = run_smoothing(subject, SmoothingScheme::explicit_euler, limits * subject.critical, 60);
            ASSERT_TRUE(!run.result.blew_up || run.result.blow_up_iteration >= earliest_blow_up(subject, limits * subject.critical));
        }
        EXPECT_GT(earliest_blow_up(subject, 0.9 * subject.critical), 1000000) << "never";
    }
}

TEST(ExplicitStudy, AllVerticesWithTheLargestValueArePeaks) {
    const std::vector<int> tied = explicit_study_on(tetrahedron(), "tetrahedron_peaks").peaks;
    EXPECT_GE(tied.size(), 1u);
    TriangleMesh spiked = icosphere(2);
    spiked.X.row(0) *= 3;   // one vertex unlike all others
    EXPECT_EQ(explicit_study_on(spiked, "spiked_peaks").peaks.size(), 1u);
    EXPECT_GT(explicit_study_on(cube_mesh(10), "cube_peaks").peaks.size(), 1u) << "a cube looks alike from all sides";
}

TEST(ExplicitStudy, CompleteGraphHasAKnownUniformLimit) {
    const ExplicitStudy study = explicit_study_on(tetrahedron(), "tetrahedron");   // −Δ_uniform of K₄: 0 and 1 + ⅓, three times
    EXPECT_NEAR(study.uniform_top, 4.0 / 3, 1e-9);
    EXPECT_NEAR(study.uniform_critical(), 1.5, 1e-9);
}

TEST(ExplicitStudy, TheLimitScalesLikeAnArea) {
    TriangleMesh large = cube_mesh(3);
    large.X *= 7;
    EXPECT_NEAR(smoothing_subject(library_mesh(large, "large")).critical,
                49 * smoothing_subject(library_mesh(cube_mesh(3), "small")).critical, 1e-6);
}

TEST(ExplicitStudy, DriftOfATranslatedMeshIsTheTranslation) {
    const SmoothingSubject subject = smoothing_subject(library_mesh(cube_mesh(3), "drift"));
    const Positions moved = subject.mesh().X.rowwise() + Eigen::RowVector3d(0.3, 0, 0.4);
    EXPECT_NEAR(barycentre_drift(subject, moved), 0.5 / subject.diagonal, 1e-12);
    EXPECT_EQ(barycentre_drift(subject, subject.mesh().X), 0);
    constexpr double large = 1e70;   // whose fifth powers are no numbers
    const SmoothingSubject grown = smoothing_subject(library_mesh({large * cube_mesh(3).X, cube_mesh(3).F}, "grown"));
    EXPECT_NEAR(barycentre_drift(grown, large * moved), 0.5 / subject.diagonal, 1e-12);
}

// Pushing a vertex of a flat grid across its ring turns some of its triangles over: these are the folds.
TEST(ExplicitStudy, AFoldedFaceFacesAwayFromItsNeighbours) {
    TriangleMesh mesh = grid_mesh(9, 9, 1, 1);
    const MeshTopology topology = topology_of(mesh);
    mesh.X(40, 0) += 0.2;   // the middle one, by 1.6 sides
    const Positions normals = face_normals(mesh);
    int folded = 0;
    for (int t = 0; t < mesh.face_count(); ++t) {
        const bool turned = normals(t, 2) < 0;
        EXPECT_EQ(is_folded(mesh, topology, normals, t), turned) << t;
        folded += turned ? 1 : 0;
    }
    EXPECT_GT(folded, 0);
    const ExplicitStudy smooth = explicit_study_on(cube_mesh(6), "cube_unfolded");
    ASSERT_TRUE(smooth.recommended);
    EXPECT_EQ(smooth.recommended->folded_before, 0);
}

}   // namespace meshfolio::q5_explicit
