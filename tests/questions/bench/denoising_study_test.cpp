#include "questions/bench/denoising_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

DenoisingStudy denoising_study_on(const TriangleMesh& mesh, const std::string& name, QuestionSettings settings = quick_settings()) {
    return denoising_study(library_mesh(mesh, name), settings);
}

int smallest_at(const std::vector<double>& values) {
    return static_cast<int>(std::min_element(values.begin(), values.end()) - values.begin());
}

}   // namespace

TEST(DenoisingStudy, TheErrorBeginsWithTheNoise) {
    const DenoisingStudy study = denoising_study_on(cube_mesh(8), "cube_noise");
    const TriangleMesh& clean = study.clean->mesh();
    for (const DenoisingTrial& trial : study.trials) {
        EXPECT_NEAR(trial.sigma, trial.relative * bounding_box(clean).diagonal(), 1e-15);
        EXPECT_EQ(trial.rms.front(), vertex_rms(clean.X, trial.noisy.X));
        EXPECT_NEAR(trial.rms.front(), std::sqrt(3.0) * trial.sigma, 5 / std::sqrt(6.0 * clean.vertex_count()) * trial.rms.front());
        EXPECT_NEAR(trial.angle.front(), compare_meshes(clean, trial.noisy).mean_normal_angle, 1e-12);
    }
}

TEST(DenoisingStudy, TheBestIterationHasTheSmallestError) {
    for (const TriangleMesh& mesh : {cube_mesh(8), icosphere(3)}) {
        const DenoisingStudy study = denoising_study_on(mesh, "best7");
        for (const DenoisingTrial& trial : study.trials) {
            EXPECT_EQ(trial.best_rms, smallest_at(trial.rms));
            EXPECT_EQ(trial.best_angle, smallest_at(trial.angle));
            EXPECT_EQ(vertex_rms(study.clean->mesh().X, trial.best.X), trial.rms[static_cast<std::size_t>(trial.best_rms)]);
            EXPECT_EQ(vertex_rms(study.clean->mesh().X, trial.last.X), trial.rms.back());
            EXPECT_NEAR(trial.angle.back(), compare_meshes(study.clean->mesh(), trial.last).mean_normal_angle, 1e-12);
            EXPECT_NEAR(trial.gain(), trial.rms.front() / *std::min_element(trial.rms.begin(), trial.rms.end()), 1e-15);
        }
    }
}

TEST(DenoisingStudy, ATrialGoesOnToTwiceItsBestIteration) {
    const DenoisingStudy study = denoising_study_on(icosphere(3), "length7");
    EXPECT_EQ(study.without_noise.size(), static_cast<std::size_t>(study.iterations) + 1);
    for (const DenoisingTrial& trial : study.trials) {
        EXPECT_EQ(trial.angle.size(), trial.rms.size());
        EXPECT_EQ(trial.iterations(), std::min(study.most_iterations, std::max(study.iterations, 2 * trial.best_rms)));
        EXPECT_EQ(trial.minimum_reached(), trial.best_rms < trial.iterations());
    }
    QuestionSettings settings = quick_settings();
    settings.noise = {0.05};   // so much that the best iteration comes late
    const DenoisingStudy late = denoising_study_on(icosphere(3), "late7", settings);
    ASSERT_GT(2 * late.trials.front().best_rms, late.iterations);
    EXPECT_EQ(late.trials.front().iterations(), std::min(late.most_iterations, 2 * late.trials.front().best_rms));
    settings = quick_settings();
    settings.iterations = {3, 5};
    for (const DenoisingTrial& trial : denoising_study_on(icosphere(2), "five7", settings).trials) EXPECT_EQ(trial.iterations(), 5);
}

TEST(DenoisingStudy, ErrorsOnAndOffFeaturesMakeUpTheWhole) {
    const DenoisingStudy study = denoising_study_on(cube_mesh(8), "cube_parts");
    const int n = study.clean->mesh().vertex_count(), on = study.feature_vertices;
    for (const DenoisingTrial& trial : study.trials) {
        const double whole = trial.rms[static_cast<std::size_t>(trial.best_rms)];
        EXPECT_NEAR(on * trial.feature_rms * trial.feature_rms + (n - on) * trial.smooth_rms * trial.smooth_rms, n * whole * whole,
                    1e-9 * n * whole * whole);
        EXPECT_GT(trial.feature_rms, trial.smooth_rms);   // edges are rounded
    }
}

TEST(DenoisingStudy, FeaturesOfACubeAreItsEdges) {
    const DenoisingStudy cube = denoising_study_on(cube_mesh(8), "cube_edges");
    EXPECT_EQ(cube.feature_vertices, 12 * 7 + 8);
    const Positions& X = cube.clean->mesh().X;
    for (int v = 0; v < X.rows(); ++v) {
        EXPECT_EQ(int(cube.on_feature[static_cast<std::size_t>(v)]), (X.row(v).array().abs() > 0.5 - 1e-6).count() >= 2 ? 1 : 0) << v;
    }
    EXPECT_EQ(denoising_study_on(icosphere(3), "ball_edges").feature_vertices, 0);
    EXPECT_TRUE(std::isnan(denoising_study_on(icosphere(2), "ball_none").trials[0].feature_rms));
    EXPECT_EQ(denoising_study_on(grid_mesh(5, 5, 1, 1), "flat_edges").feature_vertices, 0);   // a boundary is no crease
}

TEST(DenoisingStudy, WithoutNoiseTheErrorIsThatOfSmoothingAlone) {
    const DenoisingStudy study = denoising_study_on(cube_mesh(6), "cube_bias");
    EXPECT_NEAR(study.lambda, 0.1 * study.mean_edge * study.mean_edge, 1e-15);
    EXPECT_EQ(study.without_noise.front(), 0);
    for (std::size_t t = 1; t < study.without_noise.size(); ++t) EXPECT_GT(study.without_noise[t], study.without_noise[t - 1]);
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = study.lambda;
    options.iterations = 3;
    EXPECT_EQ(study.without_noise[3], vertex_rms(study.clean->mesh().X, smooth(study.clean->mesh(), options).X));
}

TEST(DenoisingStudy, AllNoiseLevelsShareOneAnalysis) {
    const DenoisingStudy study = denoising_study_on(icosphere(2), "ball_analyses");
    EXPECT_GE(study.trials.size(), 2u);
    EXPECT_EQ(study.analyses, 1);
}

TEST(DenoisingStudy, ALevelNamedTwiceIsOneTrial) {
    QuestionSettings settings = quick_settings();
    settings.noise = {0.01, 0.002, 0.01};
    const DenoisingStudy study = denoising_study_on(cube_mesh(4), "cube_levels", settings);
    ASSERT_EQ(study.trials.size(), 2u);
    EXPECT_EQ(study.trials[0].relative, 0.002);
    EXPECT_EQ(study.trials[1].relative, 0.01);
}
