#include "geometry/spectrum/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/top_lanczos.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

LargestEigenvalue uniform_top(const TriangleMesh& mesh) { return largest_eigenvalue(uniform_operator(topology_of(mesh))); }

/// |⟨X, φ⟩_M| after `steps` explicit steps from the mesh with the top mode added at `height` edges, over that before.
double measured_amplification(const TriangleMesh& mesh, double share_of_critical, int steps) {
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const LargestEigenvalue top = largest_eigenvalue(laplacian);
    const double height = 1e-3 * mean_edge_length(mesh) / top.mode.cwiseAbs().maxCoeff();
    const auto amplitude = [&](const Positions& X) { return (X.transpose() * laplacian.M.cwiseProduct(top.mode)).norm(); };
    SmoothingOptions options{.lambda = share_of_critical * largest_stable_step(top), .iterations = steps, .blow_up_at = 1e15};
    const TriangleMesh seeded{mesh.X + height * top.mode * Eigen::RowVector3d::Ones(), mesh.F};
    Positions X = seeded.X;
    for (int t = 0; t < steps; ++t) X = explicit_step(laplacian, options.lambda, X);
    return amplitude(X) / amplitude(seeded.X);
}

struct Published {
    const char* mesh;
    double critical, uniform, gershgorin_ratio, support;
};

}   // namespace

// Six neighbours at distance h, cotangents 1/√3, area √3/2 h²: μ_max = 6/h² where three directions cancel.
TEST(Stability, HexagonalGridAllowsAThirdOfHSquared) {
    EXPECT_NEAR(largest_stable_step(largest_eigenvalue(flat_torus_operator(12, 12, 1))), 1.0 / 3, 1e-12);
    EXPECT_NEAR(largest_stable_step(largest_eigenvalue(flat_torus_operator(24, 24, 1))), 1.0 / 3, 1e-10);
}

// The five-point stencil: μ_max = 8/h².
TEST(Stability, SquareGridAllowsAQuarterOfHSquared) {
    EXPECT_NEAR(largest_stable_step(largest_eigenvalue(flat_torus_operator(10, 10, std::sqrt(2.0)))), 0.25, 1e-12);
    EXPECT_NEAR(largest_stable_step(largest_eigenvalue(flat_torus_operator(40, 40, std::sqrt(2.0)))), 0.25, 1e-10);
}

TEST(Stability, LanczosFindsTheTopOfTheDenseSpectrum) {
    const LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(3));
    const DensePairs dense = dense_pairs(laplacian);
    const LargestEigenvalue top = largest_eigenvalue(laplacian);
    EXPECT_NEAR(top.value / dense.eigenvalues.tail(1)[0], 1, 1e-12);
    const Vector mode = dense.eigenvectors.rightCols(1);
    EXPECT_NEAR(std::abs(mode.dot(laplacian.M.cwiseProduct(top.mode))), 1, 1e-10);
    EXPECT_NEAR(top.mode.dot(laplacian.M.cwiseProduct(top.mode)), 1, 1e-13);
    EXPECT_EQ(top.mode.maxCoeff(), top.mode[top.vertex]);
    EXPECT_GE(top.mode.maxCoeff(), -top.mode.minCoeff());
}

// Cholesky of σM + C succeeds exactly when μ_max < σ.
TEST(Stability, CholeskyCertifiesTheLargestEigenvalue) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(20), torus_mesh(30, 15, 1, 0.4), lopsided_ellipsoid(3)}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const double mu = largest_eigenvalue(laplacian).value;
        const auto certify = [&](double sigma) {
            SparseMatrix S(mesh.vertex_count(), mesh.vertex_count());
            S = (sigma * laplacian.M).asDiagonal();
            return SparseFactor::cholesky(S + laplacian.C);
        };
        EXPECT_NO_THROW(certify(mu * (1 + 1e-8)));
        EXPECT_THROW(certify(mu * (1 - 1e-8)), SolverError);
    }
}

TEST(Stability, GershgorinBoundsFromAbove) {
    for (const TriangleMesh& mesh : {icosphere(3), irregular_sphere(3), irregular_plane(15), cube_mesh(1), grid_mesh(10, 10, 1, 1)}) {
        const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(mesh));
        EXPECT_GE(top.upper_bound, top.value * (1 - 1e-13));
        EXPECT_LE(top.upper_bound, 4 * top.value);
        EXPECT_NEAR(uniform_top(mesh).upper_bound, 2, 1e-14);
    }
}

// (1 − λμ_max)ᵗ: the law of frozen explicit smoothing, a hundredth below and above the limit.
TEST(Stability, TopModeGrowsAndDecaysAsPredicted) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(20), lopsided_ellipsoid(2)}) {
        EXPECT_NEAR(measured_amplification(mesh, 1.01, 500) / std::pow(1.02, 500), 1, 1e-4);
        EXPECT_NEAR(measured_amplification(mesh, 0.99, 300) / std::pow(0.98, 300), 1, 1e-3);
    }
}

TEST(Stability, ScalesLikeAnArea) {
    const TriangleMesh mesh = irregular_sphere(2);
    const double critical = largest_stable_step(largest_eigenvalue(laplace_beltrami(mesh)));
    for (const double s : {1e-9, 1e9}) {
        const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(scaled(mesh, s)));
        EXPECT_NEAR(largest_stable_step(top) / (critical * s * s), 1, 1e-12);
        EXPECT_GE(top.upper_bound, top.value);
    }
    EXPECT_NEAR(largest_stable_step(largest_eigenvalue(laplace_beltrami(rotated_and_moved(mesh)))) / critical, 1, 1e-11);
}

TEST(Stability, ComponentsAndUnreferencedVerticesDoNotDisturb) {
    const TriangleMesh fine = scaled(icosphere(3), 0.2), coarse = icosphere(2);
    const LargestEigenvalue alone = largest_eigenvalue(laplace_beltrami(fine));
    const TriangleMesh both = with_unreferenced_vertex(side_by_side(coarse, moved_by(fine, {5, 0, 0})), {0, 50, 0});
    const LargestEigenvalue together = largest_eigenvalue(laplace_beltrami(both));
    EXPECT_NEAR(together.value / alone.value, 1, 1e-11) << "the finer component sets the limit";
    EXPECT_GT(together.vertex, coarse.vertex_count());
    EXPECT_EQ(together.mode[0], 0);
    EXPECT_NEAR(uniform_top(both).value, std::max(uniform_top(fine).value, uniform_top(coarse).value), 1e-11);
}

TEST(Stability, SupportCountsTheVerticesOfTheMode) {
    TriangleMesh mesh = icosphere(3);
    mesh.X.row(100) += 0.95 * (mesh.X.row(topology_of(mesh).neighbours.begin(100)[0]) - mesh.X.row(100));   // one short edge
    const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(mesh));
    EXPECT_LT(top.support, 4);
    EXPECT_GT(largest_eigenvalue(flat_torus_operator(10, 10, std::sqrt(2.0))).support, 99) << "a checkerboard";
}

// Adjacency spectra of the tetrahedron (3, −1) and the icosahedron (5, √5, −1, −√5).
TEST(Stability, UniformOperatorOfPlatonicSolids) {
    TriangleMesh tetrahedron{Positions(4, 3), Faces(4, 3)};
    tetrahedron.X << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    tetrahedron.F << 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2;
    EXPECT_NEAR(uniform_top(tetrahedron).value, 4.0 / 3, 1e-14);
    EXPECT_NEAR(uniform_top(icosphere(0)).value, 1 + 1 / std::sqrt(5.0), 1e-14);
}

TEST(Stability, LimitsOfTheSharedMeshes) {
    const std::vector<Published> table = {{"coursework/decompose/armadillo.obj", 3.26e-4, 1.36, 1.76, 2.0},
                                          {"coursework/smoothing/plane_ns.obj", 4.67e-6, 1.29, 1.48, 25},
                                          {"coursework/smoothing/fandisk_ns.obj", 3.59e-4, 1.34, 1.46, 1.8},
                                          {"coursework/curvatures/lilium_s.obj", 5.39e-4, 1.30, 1.55, 2.2},
                                          {"coursework/curvatures/plane.obj", 2.68e-4, 0, 0, 0},
                                          {"classic/cube.obj", 0.247, 1.36, 1.11, 0},   // many top modes, so no one support
                                          {"classic/bunny.off", 1.93e-7, 1.36, 1.69, 1.4},
                                          {"classic/cow.off", 1.47e-6, 1.34, 1.91, 1.1}};
    for (const Published& row : table) {
        SHARED_MESH_OR_SKIP(mesh, row.mesh);
        const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(mesh));
        EXPECT_NEAR(largest_stable_step(top) / row.critical, 1, 0.003) << row.mesh;
        if (row.uniform > 0) {
            EXPECT_NEAR(largest_stable_step(uniform_top(mesh)), row.uniform, 0.006) << row.mesh;
        }
        if (row.gershgorin_ratio > 0) {
            EXPECT_NEAR(top.upper_bound / top.value, row.gershgorin_ratio, 0.006) << row.mesh;
        }
        if (row.support > 0) {
            EXPECT_NEAR(top.support / row.support, 1, 0.03) << row.mesh;
        }
    }
}

TEST(Stability, StepUnits) {
    EXPECT_EQ(step_in_model_units(3, step_unit_named("raw"), 0.5, 0.1), 3);
    EXPECT_EQ(step_in_model_units(3, step_unit_named("tau"), 0.5, 0.1), 1.5) << "tau 1 is the limit";
    EXPECT_DOUBLE_EQ(step_in_model_units(3, step_unit_named("h2"), 0.5, 0.1), 0.03);
    EXPECT_THROW(step_unit_named("metres"), UsageError);
}

TEST(Stability, OneStepInAllUnits) {
    const StepInUnits step = step_in_units(0.25, 0.5, 0.1);
    EXPECT_EQ(step.raw, 0.25);
    EXPECT_DOUBLE_EQ(step.tau, 0.5);
    EXPECT_DOUBLE_EQ(step.h2, 25);
}

// The heat kernel exp(−r²/4t) falls to 1/e at ℓ = √(4t): four times the time reaches twice as far.
TEST(Stability, SmoothingStrengthIsTheWidthOfTheHeatKernel) {
    const double diagonal = 5, reach = smoothing_strength(0.25, diagonal) * diagonal;
    EXPECT_NEAR(std::exp(-reach * reach / (4 * 0.25)), std::exp(-1), 1e-15);
    EXPECT_DOUBLE_EQ(smoothing_strength(1, diagonal), 2 * smoothing_strength(0.25, diagonal));
    EXPECT_DOUBLE_EQ(smoothing_strength(4, 2 * diagonal), smoothing_strength(1, diagonal)) << "a share of the box";
}

// Cosines are the modes of a ring: neither they nor the constant may be missing.
TEST(Stability, AnIrregularDirectionHasALittleOfEveryMode) {
    constexpr int n = 60;
    const Vector direction = irregular_direction(n);
    EXPECT_NEAR(direction.norm(), 1, 1e-15);
    EXPECT_EQ(direction, irregular_direction(n));
    for (int k = 0; k <= n / 2; ++k) {
        Vector mode(n);
        for (int i = 0; i < n; ++i) mode[i] = std::cos(2 * pi * k * i / n);
        EXPECT_GT(std::abs(direction.dot(mode.normalized())), 1e-4) << k;
    }
}

TEST(Stability, RefusesMeshesWithoutArea) {
    EXPECT_THROW(largest_eigenvalue({SparseMatrix(0, 0), Vector(0)}), MeshError);
    EXPECT_THROW(largest_eigenvalue({SparseMatrix(3, 3), Vector::Zero(3)}), MeshError);
}
