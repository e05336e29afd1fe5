#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/stability.h"
#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// A sphere with a neck: curvature flow pinches it, so the limit of the rebuilt operator falls.
TriangleMesh dumbbell() {
    TriangleMesh mesh = irregular_sphere(3);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double x = mesh.X(v, 0), waist = 0.15 + 0.85 * x * x;
        mesh.X(v, 0) = 2 * x;
        mesh.X(v, 1) *= waist;
        mesh.X(v, 2) *= waist;
    }
    return mesh;
}

SmoothingOptions curvature_flow(double lambda, int iterations) {
    SmoothingOptions options;
    options.lambda = lambda;
    options.iterations = iterations;
    options.rebuild = true;
    options.monitor = true;
    return options;
}

}   // namespace

TEST(LimitWatch, AFrozenOperatorHasOneLimit) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    SmoothingOptions options{.lambda = 0.3 * critical_step(mesh), .iterations = 4, .monitor = true};
    const Smoothed result = smooth(mesh, options);
    ASSERT_EQ(result.steps.size(), 4u);
    const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(mesh));
    for (const StepStability& step : result.steps) {
        EXPECT_NEAR(step.top, 0.6, 1e-8);
        EXPECT_EQ(step.vertex, top.vertex);
        EXPECT_NEAR(step.bound / (options.lambda * top.upper_bound), 1, 1e-12);
        EXPECT_NEAR(step.lambda / options.lambda, 1, 1e-14);
    }
    EXPECT_EQ(result.crossing_iteration, 0);
    EXPECT_NEAR(result.time / (4 * options.lambda), 1, 1e-14);
}

TEST(LimitWatch, AFixedStepCrossesTheLimitOfThePinchingNeck) {
    const TriangleMesh mesh = dumbbell();
    const Smoothed result = smooth(mesh, curvature_flow(0.5 * critical_step(mesh), 60));
    ASSERT_FALSE(result.steps.empty());
    EXPECT_NEAR(result.steps.front().top, 1, 1e-6) << "it begins at half the limit";
    ASSERT_GT(result.crossing_iteration, 1);
    const std::size_t crossing = static_cast<std::size_t>(result.crossing_iteration) - 1;
    EXPECT_GT(result.steps[crossing].top, 2);
    EXPECT_EQ(result.crossing_vertex, result.steps[crossing].vertex);
    for (std::size_t t = 0; t < crossing; ++t) EXPECT_LE(result.steps[t].top, 2) << t;
    for (const StepStability& step : result.steps) {
        EXPECT_FALSE(step.top > step.bound);
    }
}

TEST(LimitWatch, AnAdaptiveStepNeverCrosses) {
    const TriangleMesh mesh = dumbbell();
    for (const double share : {0.5, 1.0}) {
        SmoothingOptions options = curvature_flow(0.5 * critical_step(mesh), 60);
        options.adaptive = share;
        const Smoothed result = smooth(mesh, options);
        EXPECT_EQ(result.crossing_iteration, 0);
        EXPECT_FALSE(result.blew_up);
        double time = 0;
        for (const StepStability& step : result.steps) {
            EXPECT_LE(step.bound, 2 * share * (1 + 1e-15));
            EXPECT_LE(step.top, step.bound);
            EXPECT_LE(step.lambda, options.lambda * (1 + 1e-15));
            time += step.lambda;
        }
        EXPECT_NEAR(result.time / time, 1, 1e-13);
        EXPECT_LT(result.time, 60 * options.lambda);
        EXPECT_GT(result.time, 0);
    }
}

// λ far beyond the limit: fixed it blows up, adaptive it cannot.
TEST(LimitWatch, AnAdaptiveStepSavesARunThatWouldBlowUp) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    SmoothingOptions options{.lambda = 20 * critical_step(mesh), .iterations = 30, .monitor = true};
    const Smoothed fixed = smooth(mesh, options);
    EXPECT_TRUE(fixed.blew_up);
    EXPECT_EQ(fixed.crossing_iteration, 1);
    EXPECT_EQ(fixed.steps.size(), std::size_t(fixed.blow_up_iteration));
    options.adaptive = 1;
    const Smoothed adaptive = smooth(mesh, options);
    EXPECT_FALSE(adaptive.blew_up);
    EXPECT_EQ(adaptive.iterations, 30);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    EXPECT_LT(dirichlet_energy(laplacian.C, adaptive.X), dirichlet_energy(laplacian.C, mesh.X));
}

TEST(LimitWatch, WatchingChangesNothingAndSmallStepsAreLeftAlone) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    SmoothingOptions options = curvature_flow(0.05 * critical_step(mesh), 10);
    options.monitor = false;
    const Smoothed plain = smooth(mesh, options);
    EXPECT_TRUE(plain.steps.empty());
    options.monitor = true;
    EXPECT_EQ(smooth(mesh, options).X, plain.X);
    options.adaptive = 1;
    EXPECT_EQ(smooth(mesh, options).X, plain.X) << "every step is below its limit";
}

TEST(LimitWatch, ScalesLikeAnArea) {
    const TriangleMesh mesh = dumbbell();
    const double lambda = 0.5 * critical_step(mesh), s = 37.5;
    SmoothingOptions options = curvature_flow(lambda, 10);
    options.adaptive = 0.9;
    const Smoothed small = smooth(mesh, options);
    options.lambda *= s * s;
    const Smoothed large = smooth(scaled(mesh, s), options);
    EXPECT_NEAR(large.time / (small.time * s * s), 1, 1e-9);
    for (std::size_t t = 0; t < 10; ++t) EXPECT_NEAR(large.steps[t].top / small.steps[t].top, 1, 1e-6) << t;
}

TEST(LimitWatch, TheUniformOperatorIsWatchedToo) {
    const TriangleMesh mesh = irregular_sphere(2);
    SmoothingOptions options{.laplacian = OperatorKind::uniform, .lambda = 5, .iterations = 3, .monitor = true, .adaptive = 1};
    for (const StepStability& step : smooth(mesh, options).steps) {
        EXPECT_NEAR(step.lambda, 1, 1e-13) << "the bound of the uniform operator is 2";
        EXPECT_LE(step.top, 2);
    }
}

TEST(LimitWatch, RefusesSchemesWithoutLimitAndSharesBeyondOne) {
    const TriangleMesh mesh = icosphere(1);
    for (const double share : {-0.1, 1.1, std::nan("")}) {
        EXPECT_THROW(smooth(mesh, {.lambda = 0.01, .adaptive = share}), MeshError) << share;
    }
    EXPECT_THROW(smooth(mesh, {.scheme = SmoothingScheme::implicit_euler, .lambda = 0.01, .monitor = true}), MeshError);
    EXPECT_THROW(smooth(mesh, {.scheme = SmoothingScheme::taubin, .lambda = 0.01, .adaptive = 0.5}), MeshError);
}

// mathematics.md §3: the bunny at λ = 1e-7, half its limit, crosses 2 before step 50.
TEST(LimitWatch, TheBunnyAtHalfItsLimit) {
    SHARED_MESH_OR_SKIP(mesh, "classic/bunny.off");
    const Smoothed fixed = smooth(mesh, curvature_flow(1e-7, 50));
    EXPECT_NEAR(fixed.steps.front().top, 1.04, 0.005);
    EXPECT_GT(fixed.crossing_iteration, 0);
    EXPECT_LT(fixed.crossing_iteration, 50);
    SmoothingOptions options = curvature_flow(1e-7, 50);
    options.adaptive = 0.95;
    EXPECT_EQ(smooth(mesh, options).crossing_iteration, 0);
}
