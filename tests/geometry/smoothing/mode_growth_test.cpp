#include "geometry/smoothing/mode_growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// 1000 steps at `share` of the limit, from the mesh with the top mode a thousandth of an edge high.
ModeGrowth growth_at(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, double share, int steps = 1000) {
    const LargestEigenvalue top = largest_eigenvalue(laplacian);
    return mode_growth(laplacian, top, seeded(mesh.X, top, 1e-3 * mean_edge_length(mesh)), share * largest_stable_step(top), steps);
}

std::vector<TriangleMesh> meshes() { return {irregular_sphere(3), irregular_plane(15), lopsided_ellipsoid(2), cube_mesh(6)}; }

}   // namespace

// 1.02¹⁰⁰⁰ = 3.983e8 and 0.98¹⁰⁰⁰ = 1.683e-9, for cotangents and for the uniform operator alike.
TEST(ModeGrowth, AHundredthBeyondTheLimitGrowsAndAHundredthBelowDecays) {
    for (const TriangleMesh& mesh : meshes()) {
        for (const LaplaceBeltrami& laplacian : {laplace_beltrami(mesh), uniform_operator(topology_of(mesh))}) {
            const ModeGrowth beyond = growth_at(mesh, laplacian, 1.01), below = growth_at(mesh, laplacian, 0.99);
            ASSERT_EQ(beyond.steps(), 1000);
            EXPECT_NEAR(beyond.predicted(1000) / 3.98264652e8, 1, 1e-7);
            EXPECT_NEAR(below.predicted(1000) / 1.68296736e-9, 1, 1e-7);
            EXPECT_NEAR(beyond.factor.back() / beyond.predicted(1000), 1, 1e-6);
            EXPECT_LT(below.factor.back(), 1e-6) << "rounding keeps it from falling further";
            for (const int t : {1, 10, 100}) EXPECT_NEAR(below.factor[std::size_t(t)] / below.predicted(t), 1, 1e-6) << t;
            for (int t = 1; t <= 1000; ++t) EXPECT_LE(below.factor[std::size_t(t)], below.factor[std::size_t(t) - 1] + 1e-9) << t;
        }
    }
}

TEST(ModeGrowth, EveryModeObeysTheLaw) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const DensePairs dense = dense_pairs(laplacian);
    const double lambda = 0.9 * 2 / dense.eigenvalues.tail(1)[0];
    for (const Eigen::Index k : {1, 7, 40, 100}) {
        LargestEigenvalue mode;
        mode.value = dense.eigenvalues[k];
        mode.mode = dense.eigenvectors.col(k);
        const ModeGrowth growth = mode_growth(laplacian, mode, seeded(mesh.X, mode, 0.1), lambda, 12);
        for (int t = 0; t <= 12; ++t) EXPECT_NEAR(growth.factor[std::size_t(t)], growth.predicted(t), 1e-9) << k << " " << t;
    }
}

TEST(ModeGrowth, StepsAreThoseOfExplicitSmoothing) {
    const TriangleMesh mesh = irregular_sphere(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const LargestEigenvalue top = largest_eigenvalue(laplacian);
    const double lambda = 0.7 * largest_stable_step(top);
    const Positions start = seeded(mesh.X, top, 1e-2);
    const auto amplitude = [&](const Positions& X) { return (X.transpose() * laplacian.M.cwiseProduct(top.mode)).norm(); };
    const ModeGrowth growth = mode_growth(laplacian, top, start, lambda, 5);
    Positions X = start;
    for (int t = 0; t < 5; ++t) X = explicit_step(laplacian, lambda, X);
    EXPECT_NEAR(growth.factor.back(), amplitude(X) / amplitude(start), 1e-12);
}

TEST(ModeGrowth, IgnoresPlaceAndScale) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const double here = growth_at(mesh, laplace_beltrami(mesh), 1.01, 300).factor.back();
    const TriangleMesh away = moved_by(scaled(mesh, 1e-3), {1, -2, 3});
    EXPECT_NEAR(growth_at(away, laplace_beltrami(away), 1.01, 300).factor.back() / here, 1, 1e-6);
}

TEST(ModeGrowth, RefusesPositionsWithoutTheMode) {
    const TriangleMesh mesh = irregular_sphere(1);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    LargestEigenvalue top = largest_eigenvalue(laplacian);
    EXPECT_THROW(mode_growth(laplacian, top, mesh.X.topRows(5), 1, 1), MeshError);
    EXPECT_THROW(mode_growth(laplacian, top, Positions::Zero(mesh.vertex_count(), 3), 1, 1), MeshError);
    top.mode.conservativeResize(3);
    EXPECT_THROW(mode_growth(laplacian, top, mesh.X, 1, 1), MeshError);
}
