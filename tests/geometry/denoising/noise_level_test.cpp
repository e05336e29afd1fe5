#include "geometry/denoising/noise_level.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

#include "base/errors.h"
#include "geometry/operator_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

TriangleMesh with_noise(const TriangleMesh& mesh, double sigma, std::uint64_t seed = 5) {
    return moved_to(mesh, with_gaussian_noise(mesh.X, Vector3::Constant(sigma), seed));
}

/// σ̂/σ for noise of that many mean edges.
double ratio(const TriangleMesh& clean, double edges) {
    const TriangleMesh noisy = with_noise(clean, edges * mean_edge_length(clean));
    return noise_level(noisy, topology_of(noisy)).sigma / (edges * mean_edge_length(clean));
}

}   // namespace

// Fractiles of χ² from printed tables.
TEST(NoiseLevel, QuantilesOfChiSquare) {
    EXPECT_NEAR(chi_square_quantile(-0.674490, 10), 6.7372, 0.02);
    EXPECT_NEAR(chi_square_quantile(2.326348, 10), 23.209, 0.05);
    EXPECT_NEAR(chi_square_quantile(2.326348, 2), 9.210, 0.1);
    EXPECT_NEAR(chi_square_share(23.209, 10), 0.99, 1e-3);
    EXPECT_NEAR(chi_square_share(9.342, 10), 0.5, 2e-3);
    for (const double k : {2.0, 7.0, 30.0}) EXPECT_NEAR(chi_square_share(chi_square_quantile(1, k), k), 0.841345, 1e-6);
}

TEST(NoiseLevel, FindsTheNoiseOfSmoothSurfaces) {
    for (const double edges : {0.1, 0.3, 1.0}) {
        EXPECT_NEAR(ratio(icosphere(4), edges), 1, 0.05) << edges;
        EXPECT_NEAR(ratio(torus_mesh(64, 32, 1, 0.4), edges), 1, 0.05) << edges;
        EXPECT_NEAR(ratio(irregular_sphere(4), edges), 1, 0.07) << edges;
        EXPECT_NEAR(ratio(irregular_plane(40), edges), 1, 0.07) << edges;
    }
    EXPECT_NEAR(ratio(icosphere(4), 0.01), 1, 0.1);
}

// A fifth of the patches crosses an edge of a cube with 20 × 20 squares a side; their residuals do not count.
TEST(NoiseLevel, PatchesOnCreasesAreIgnored) {
    EXPECT_NEAR(ratio(cube_mesh(20), 0.03), 1, 0.08);
    EXPECT_NEAR(ratio(cube_mesh(20), 0.1), 1, 0.08);
    const TriangleMesh noisy = with_noise(cube_mesh(20), 0.03 * mean_edge_length(cube_mesh(20)));
    const NoiseLevel level = noise_level(noisy, topology_of(noisy));
    EXPECT_EQ(level.patches, noisy.vertex_count());
    EXPECT_LT(level.kept, 0.9 * level.patches);
    EXPECT_GT(level.kept, 0.5 * level.patches);
}

// If every patch crosses an edge, shape and noise cannot be distinguished.
TEST(NoiseLevel, TakesTheShapeOfACoarseMeshForNoise) {
    EXPECT_GT(ratio(cube_mesh(3), 0.02), 3);
    EXPECT_GT(ratio(icosphere(1), 0.001), 2);
}

TEST(NoiseLevel, ScalesAndTurnsWithTheMesh) {
    const TriangleMesh noisy = with_noise(torus_mesh(40, 20, 1, 0.4), 0.02);
    const MeshTopology topology = topology_of(noisy);
    const double sigma = noise_level(noisy, topology).sigma;
    EXPECT_NEAR(noise_level({1e4 * noisy.X, noisy.F}, topology).sigma, 1e4 * sigma, 1e-6 * 1e4 * sigma);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    EXPECT_NEAR(noise_level({noisy.X * turn, noisy.F}, topology).sigma, sigma, 1e-6 * sigma);
    EXPECT_NEAR(noise_level({noisy.X.rowwise() + Eigen::RowVector3d(100, -50, 7), noisy.F}, topology).sigma, sigma, 1e-6 * sigma);
}

TEST(NoiseLevel, NoneOnAPlane) {
    const TriangleMesh plane = irregular_plane(12);
    EXPECT_LT(noise_level(plane, topology_of(plane)).sigma, 1e-14);
}

TEST(NoiseLevel, UndefinedWithoutEnoughPoints) {
    const TriangleMesh one = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const NoiseLevel level = noise_level(one, topology_of(one));
    EXPECT_TRUE(std::isnan(level.sigma));
    EXPECT_EQ(level.patches, 0);
    EXPECT_THROW(noise_level(one, topology_of(icosphere(1))), MeshError);
}
