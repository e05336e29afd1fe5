#include "geometry/smoothing/stability_certificate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Encloses the largest eigenvalue, beginning with a guess of its mode.
Enclosure enclosed_from(const LaplaceBeltrami& laplacian, const Vector& mode) {
    const OperatorWithMass whole = operator_with_mass(laplacian);
    return enclose_largest(whole.A, whole.M, mode(whole.vertex), {.high = gershgorin_bound(whole.A, whole.M)});
}

LaplaceBeltrami uniform_pair(const TriangleMesh& mesh) { return uniform_operator(topology_of(mesh)); }

std::vector<TriangleMesh> small_meshes() {
    return {irregular_sphere(2), irregular_plane(12), torus_mesh(16, 9, 1, 0.4), lopsided_ellipsoid(2), cube_mesh(3)};
}

}   // namespace

TEST(StabilityCertificate, HoldsTheDenseEigenvalueBetweenItsBounds) {
    for (const TriangleMesh& mesh : small_meshes()) {
        for (const LaplaceBeltrami& laplacian : {laplace_beltrami(mesh), uniform_pair(mesh)}) {
            const double mu = dense_pairs(laplacian).eigenvalues.tail(1)[0];
            const StabilityCertificate certificate = stability_certificate(laplacian);
            EXPECT_LE(certificate.mu_low, mu * (1 + 1e-13));
            EXPECT_GE(certificate.mu_high, mu * (1 - 1e-13));
            EXPECT_LE(certificate.relative_width(), 1e-8);
            EXPECT_GT(certificate.relative_width(), 0);
            EXPECT_EQ(certificate.factorisations, 1) << "Lanczos had it";
            EXPECT_FALSE(certificate.refuted());
            EXPECT_LE(certificate.lambda_low(), 2 / mu);
            EXPECT_GE(certificate.lambda_high(), 2 / mu * (1 - 1e-13));
        }
    }
}

// The k-th mode from the top is an eigenpair too: only the factorisation can tell that it is not the largest.
TEST(StabilityCertificate, AGuessThatMissedTheTopIsRefutedAndRepaired) {
    for (const TriangleMesh& mesh : small_meshes()) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const auto spectrum = dense_pairs(laplacian);
        const Eigen::Index n = spectrum.eigenvalues.size();
        const double mu = spectrum.eigenvalues[n - 1];
        for (const Eigen::Index wrong : {n - 2, n - 5, n / 2, Eigen::Index{0}}) {
            if (spectrum.eigenvalues[wrong] > mu * (1 - 1e-7)) continue;   // as large as the top
            const Enclosure enclosure = enclosed_from(laplacian, spectrum.eigenvectors.col(wrong));
            EXPECT_GT(enclosure.failed, 0) << wrong;
            EXPECT_LE(enclosure.low, mu * (1 + 1e-13));
            EXPECT_GE(enclosure.high, mu * (1 - 1e-13));
            EXPECT_LE(enclosure.high / enclosure.low - 1, 1e-8);
            EXPECT_NEAR(enclosure.quotient / mu, 1, 1e-8);
            EXPECT_LT(enclosure.factorisations, 60);
        }
    }
}

TEST(StabilityCertificate, ARepairedGuessHasTheTopMode) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const LargestEigenvalue top = largest_eigenvalue(laplacian);
    const Enclosure enclosure = enclosed_from(laplacian, Vector::Ones(mesh.vertex_count()));
    const LargestEigenvalue repaired = top_mode(operator_with_mass(laplacian), enclosure.quotient, enclosure.y);
    EXPECT_EQ(repaired.vertex, top.vertex);
    EXPECT_NEAR(repaired.support / top.support, 1, 1e-3);
    EXPECT_NEAR(repaired.mode.dot(laplacian.M.cwiseProduct(repaired.mode)), 1, 1e-12);
}

TEST(StabilityCertificate, AGuessWithoutDirectionDoesNoHarm) {
    const LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(2));
    const double mu = largest_eigenvalue(laplacian).value;
    for (const double entry : {0.0, std::nan(""), HUGE_VAL}) {
        const Enclosure enclosure = enclosed_from(laplacian, Vector::Constant(laplacian.M.size(), entry));
        EXPECT_LE(enclosure.high / enclosure.low - 1, 1e-8) << entry;
        EXPECT_NEAR(enclosure.quotient / mu, 1, 1e-8) << entry;
    }
}

// σ on the wrong side of μ_max: Cholesky breaks down below it and nowhere above.
TEST(StabilityCertificate, CholeskySucceedsOnlyAboveTheTop) {
    for (const TriangleMesh& mesh : small_meshes()) {
        for (const LaplaceBeltrami& laplacian : {laplace_beltrami(mesh), uniform_pair(mesh)}) {
            const StabilityCertificate certificate = stability_certificate(laplacian);
            EXPECT_FALSE(is_positive_definite_at(laplacian, certificate.mu_low * (1 - 1e-8)));
            EXPECT_TRUE(is_positive_definite_at(laplacian, certificate.mu_high * (1 + 1e-8)));
            EXPECT_FALSE(is_positive_definite_at(laplacian, 0.5 * certificate.mu_low));
            EXPECT_FALSE(is_positive_definite_at(laplacian, -certificate.mu_high));
            EXPECT_TRUE(is_positive_definite_at(laplacian, certificate.top.upper_bound * (1 + 1e-12)));
        }
    }
}

TEST(StabilityCertificate, GridsHaveTheirClosedForm) {
    const StabilityCertificate hexagonal = stability_certificate(flat_torus_operator(24, 24, 1));
    EXPECT_LE(hexagonal.lambda_low(), 1.0 / 3 * (1 + 1e-13));
    EXPECT_GE(hexagonal.lambda_high(), 1.0 / 3 * (1 - 1e-13));
    EXPECT_LE(hexagonal.relative_width(), 1e-8);
    const StabilityCertificate square = stability_certificate(flat_torus_operator(40, 40, std::sqrt(2.0)));
    EXPECT_LE(square.lambda_low(), 0.25 * (1 + 1e-13));
    EXPECT_GE(square.lambda_high(), 0.25 * (1 - 1e-13));
}

// A free boundary lowers the limit of the grid a little.
TEST(StabilityCertificate, AGridWithBoundaryComesNearTheSquareOfItsEdge) {
    const double h = 1.0 / 19;   // 20 points a side
    const StabilityCertificate certificate = stability_certificate(laplace_beltrami(grid_mesh(20, 20, 1, 1)));
    EXPECT_LT(certificate.lambda_high(), h * h / 4);
    EXPECT_GT(certificate.lambda_low(), 0.9 * h * h / 4);
}

TEST(StabilityCertificate, ScalesLikeAnAreaAndIgnoresMotionsAndNumbering) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const StabilityCertificate certificate = stability_certificate(laplace_beltrami(mesh));
    for (const double s : {1e-9, 0.37, 1e9}) {
        const StabilityCertificate other = stability_certificate(laplace_beltrami(scaled(mesh, s)));
        EXPECT_NEAR(other.lambda_low() / (certificate.lambda_low() * s * s), 1, 1e-11);
        EXPECT_NEAR(other.lambda_high() / (certificate.lambda_high() * s * s), 1, 1e-11);
    }
    const StabilityCertificate moved = stability_certificate(laplace_beltrami(rotated_and_moved(mesh)));
    EXPECT_NEAR(moved.lambda_low() / certificate.lambda_low(), 1, 1e-10);
    TriangleMesh reversed{mesh.X.colwise().reverse(), (mesh.vertex_count() - 1 - mesh.F.array()).matrix()};
    const StabilityCertificate renumbered = stability_certificate(laplace_beltrami(reversed));
    EXPECT_NEAR(renumbered.lambda_low() / certificate.lambda_low(), 1, 1e-10);
    EXPECT_EQ(renumbered.top.vertex, mesh.vertex_count() - 1 - certificate.top.vertex);
}

TEST(StabilityCertificate, UniformOperatorLiesBetweenZeroAndTwo) {
    for (const TriangleMesh& mesh : small_meshes()) {
        const StabilityCertificate certificate = stability_certificate(uniform_pair(mesh));
        EXPECT_GT(certificate.mu_low, 1) << "trace n, so some eigenvalue beyond 1";
        EXPECT_LE(certificate.mu_high, 2 * (1 + 1e-8));
    }
}

TEST(StabilityCertificate, UnreferencedVerticesAreLeftOut) {
    const TriangleMesh mesh = irregular_sphere(2);
    const StabilityCertificate alone = stability_certificate(laplace_beltrami(mesh));
    const StabilityCertificate more = stability_certificate(laplace_beltrami(with_unreferenced_vertex(mesh, {0, 50, 0})));
    EXPECT_NEAR(more.mu_high / alone.mu_high, 1, 1e-12);
    EXPECT_EQ(more.top.vertex, alone.top.vertex + 1);
}

TEST(StabilityCertificate, BoundsAreWiderThanAskedWhereRoundingForbidsMore) {
    const LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(3));
    const StabilityCertificate narrow = stability_certificate(laplacian, {.width = 1e-15});
    EXPECT_GT(narrow.relative_width(), 1e-15);
    EXPECT_LT(narrow.relative_width(), 1e-9);
    const double mu = dense_pairs(laplacian).eigenvalues.tail(1)[0];
    EXPECT_LE(narrow.mu_low, mu * (1 + 1e-13));
    EXPECT_GE(narrow.mu_high, mu * (1 - 1e-13));
    EXPECT_LE(stability_certificate(laplacian, {.width = 1e-3}).relative_width(), 1e-3);
}

// On homogeneous meshes the top eigenvalues crowd together, and eigenvectors cannot be separated.
TEST(StabilityCertificate, CrowdedTopsHaveTheirClosedForm) {
    for (const auto& [columns, rows] : {std::pair{120, 120}, {1500, 6}, {6, 1500}}) {
        const LaplaceBeltrami laplacian = flat_torus_operator(columns, rows, 1);
        const StabilityCertificate certificate = stability_certificate(laplacian);
        EXPECT_LE(certificate.lambda_low(), 1.0 / 3 * (1 + 1e-13)) << columns;
        EXPECT_GE(certificate.lambda_high(), 1.0 / 3 * (1 - 1e-13)) << columns;
        EXPECT_LE(certificate.relative_width(), 1e-8) << columns;
        EXPECT_LT(certificate.factorisations, 12) << columns;
        EXPECT_NEAR(3 * largest_stable_step(largest_eigenvalue(laplacian)), 1, 1e-8);
        const double nearly = 3 * largest_stable_step(largest_eigenvalue_nearly(operator_with_mass(laplacian)));
        EXPECT_GE(nearly, 1 - 1e-13) << "too small an eigenvalue, never too large a one";
        EXPECT_LE(nearly, 1 + 1e-4);
    }
}

TEST(StabilityCertificate, IsTheSameEveryTime) {
    const LaplaceBeltrami laplacian = flat_torus_operator(900, 6, 1);
    const StabilityCertificate one = stability_certificate(laplacian), two = stability_certificate(laplacian);
    EXPECT_EQ(one.mu_low, two.mu_low);
    EXPECT_EQ(one.mu_high, two.mu_high);
    EXPECT_EQ(one.top.mode, two.top.mode);
    EXPECT_EQ(one.top.vertex, two.top.vertex);
}

TEST(StabilityCertificate, RefusesMeshesWithoutEdges) {
    EXPECT_THROW(stability_certificate({SparseMatrix(3, 3), Vector::Ones(3)}), MeshError);
    EXPECT_THROW(stability_certificate({SparseMatrix(3, 3), Vector::Zero(3)}), MeshError);
}

// Known limits of two digits, proved to eight.
TEST(StabilityCertificate, SharedMeshes) {
    struct Published {
        const char* mesh;
        double critical;
    };
    for (const Published& row :
         {Published{"coursework/decompose/armadillo.obj", 3.26e-4}, Published{"coursework/smoothing/plane_ns.obj", 4.67e-6},
          Published{"coursework/smoothing/fandisk_ns.obj", 3.59e-4}, Published{"coursework/curvatures/lilium_s.obj", 5.39e-4},
          Published{"classic/cube.obj", 0.247}, Published{"classic/bunny.off", 1.93e-7}, Published{"classic/cow.off", 1.47e-6}}) {
        SHARED_MESH_OR_SKIP(mesh, row.mesh);
        const StabilityCertificate certificate = stability_certificate(laplace_beltrami(mesh));
        EXPECT_LE(certificate.relative_width(), 1e-8) << row.mesh;
        EXPECT_NEAR(certificate.lambda_low() / row.critical, 1, 0.003) << row.mesh;
        EXPECT_LE(stability_certificate(uniform_pair(mesh)).relative_width(), 1e-8) << row.mesh;
    }
}
