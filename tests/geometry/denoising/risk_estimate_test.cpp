#include "geometry/denoising/risk_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/denoising/denoising_prediction.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

constexpr int step_count = 8;
constexpr double amount = 1e-5;

/// Implicit steps with the operator of the input mesh, the noise's own.
Trajectory own_run(const TriangleMesh& mesh, const Positions& Y, double lambda) {
    Trajectory run{Y};
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = lambda;
    options.iterations = step_count;
    options.after_step = [&](int, const Positions& X) {
        run.push_back(X);
        return true;
    };
    smooth(moved_to(mesh, Y), options);
    return run;
}

Trajectory fixed_run(const LaplaceBeltrami& laplacian, const Positions& Y, double lambda) {
    Trajectory run{Y};
    for (int t = 0; t < step_count; ++t) run.push_back(implicit_step(laplacian, lambda, run.back()));
    return run;
}

/// Differences estimate − error over the seeds, in standard errors, the largest over the iterations.
template <class Run> double distance_from_error(const TriangleMesh& mesh, double sigma, Run run, double sigma_told) {
    constexpr int seeds = 30;
    DenseMatrix off(seeds, step_count + 1);
    for (int s = 0; s < seeds; ++s) {
        const Positions Y = with_gaussian_noise(mesh.X, Vector3::Constant(sigma), 70 + static_cast<std::uint64_t>(s));
        const Positions z = random_signs(Y.rows(), 900 + static_cast<std::uint64_t>(s));
        const Trajectory straight = run(Y);
        const Vector risk = risk_estimate(straight, run(Y + amount * z), z, amount).risk(sigma_told);
        for (int t = 0; t <= step_count; ++t) off(s, t) = risk[t] - (straight[static_cast<std::size_t>(t)] - mesh.X).squaredNorm();
    }
    double farthest = 0;
    for (int t = 0; t <= step_count; ++t) {
        const double mean = off.col(t).mean();
        farthest = std::max(farthest, std::abs(mean) / std::sqrt((off.col(t).array() - mean).square().sum() / (seeds - 1.0) / seeds));
    }
    return farthest;
}

}   // namespace

TEST(RiskEstimate, BeginsWithTheNoise) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const Positions z = random_signs(mesh.X.rows(), 1);
    const RiskEstimate estimate = risk_estimate({mesh.X}, {mesh.X + amount * z}, z, amount);
    EXPECT_NEAR(estimate.divergence[0], 3 * mesh.vertex_count(), 1e-6);
    EXPECT_NEAR(estimate.risk(0.1)[0], 3 * mesh.vertex_count() * 0.01, 1e-6);
    EXPECT_EQ(estimate.best(0.1), 0);
}

// For a given matrix the divergence is three times its trace.
TEST(RiskEstimate, DivergenceOfAGivenOperatorIsItsTrace) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double lambda = 0.02;
    Vector trace = Vector::Zero(step_count + 1);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        Positions unit = Positions::Zero(mesh.vertex_count(), 3);
        unit(v, 0) = 1;
        const Trajectory run = fixed_run(laplacian, unit, lambda);
        for (int t = 0; t <= step_count; ++t) trace[t] += 3 * run[static_cast<std::size_t>(t)](v, 0);
    }
    constexpr int probes = 40;
    DenseMatrix values(probes, step_count + 1);
    for (int p = 0; p < probes; ++p) {
        const Positions z = random_signs(mesh.X.rows(), 10 + static_cast<std::uint64_t>(p));
        values.row(p) = risk_estimate(fixed_run(laplacian, mesh.X, lambda), fixed_run(laplacian, mesh.X + amount * z, lambda), z, amount)
                            .divergence.transpose();
    }
    for (int t = 1; t <= step_count; ++t) {
        const double mean = values.col(t).mean();
        const double spread = std::sqrt((values.col(t).array() - mean).square().sum() / (probes - 1.0) / probes);
        EXPECT_LT(std::abs(mean - trace[t]), 4 * spread) << t;
        EXPECT_LT(spread, 0.03 * trace[t]);
    }
}

// Stein's identity, also for an operator made from the noisy mesh; with a wrong σ it fails.
TEST(RiskEstimate, IsTheErrorInTheMean) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double edge = mean_edge_length(mesh), sigma = 0.3 * edge, lambda = 0.1 * edge * edge;
    const auto given = [&](const Positions& Y) { return fixed_run(laplacian, Y, lambda); };
    const auto own = [&](const Positions& Y) { return own_run(mesh, Y, lambda); };
    EXPECT_LT(distance_from_error(mesh, sigma, given, sigma), 4);
    EXPECT_LT(distance_from_error(mesh, sigma, own, sigma), 4);
    EXPECT_GT(distance_from_error(mesh, sigma, own, 1.2 * sigma), 4);
}

TEST(RiskEstimate, ChoosesByResidualAndDivergence) {
    RiskEstimate estimate;
    estimate.numbers = 100;
    estimate.residual.resize(5);
    estimate.residual << 0, 30, 60, 95, 140;
    estimate.divergence.resize(5);
    estimate.divergence << 100, 60, 40, 30, 25;
    const Vector risk = estimate.risk(1);
    EXPECT_EQ(risk[0], 100);
    EXPECT_EQ(risk[2], 40);
    EXPECT_EQ(estimate.best(1), 2);
    EXPECT_EQ(estimate.by_discrepancy(1), 4) << "the first beyond 100";
    EXPECT_EQ(estimate.by_discrepancy(0.5), 1);
    EXPECT_EQ(estimate.by_discrepancy(2), 4) << "never: the last";
    EXPECT_EQ(estimate.best(0.1), 0);
}

// Collapsing triangles amplify noise without limit: later estimates are unreliable even if they are small.
TEST(RiskEstimate, StopsWhereTheDivergenceRises) {
    RiskEstimate estimate;
    estimate.numbers = 100;
    estimate.residual.resize(5);
    estimate.residual << 0, 10, 20, 30, 30;
    estimate.divergence.resize(5);
    estimate.divergence << 100, 60, 50, 58, -500;
    EXPECT_EQ(estimate.best(1), 2);
    estimate.divergence[3] = 54;
    estimate.divergence[4] = -500;
    EXPECT_EQ(estimate.best(1), 4) << "a small rise is the chance of one probe";
    estimate.divergence[3] = NAN;
    EXPECT_EQ(estimate.best(1), 2);
}

TEST(RiskEstimate, RefusesRunsOfDifferentLength) {
    const TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(risk_estimate({}, {}, mesh.X, 1), MeshError);
    EXPECT_THROW(risk_estimate({mesh.X}, {mesh.X, mesh.X}, mesh.X, 1), MeshError);
}
