#include "geometry/spectrum/definiteness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/smoothing/stability_certificate.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

double dense_smallest(const LaplaceBeltrami& laplacian) { return dense_pairs(laplacian).eigenvalues[0]; }

/// Returns a ring with weight 1 between neighbours, weight −b between second neighbours, and masses m.
LaplaceBeltrami ring_operator(int n, double b, double m) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
        for (const auto& [step, weight] : {std::pair{1, 1.0}, {2, -b}}) {
            const int j = (i + step) % n;
            entries.emplace_back(i, j, weight);
            entries.emplace_back(j, i, weight);
            entries.emplace_back(i, i, -weight);
            entries.emplace_back(j, j, -weight);
        }
    }
    LaplaceBeltrami laplacian{SparseMatrix(n, n), Vector::Constant(n, m)};
    laplacian.C.setFromTriplets(entries.begin(), entries.end());
    return laplacian;
}

/// Its eigenvalues are 2(1 − c)(1 − 2b(1 + c))/m, c = cos 2πk/n.
double smallest_of_ring(int n, double b, double m) {
    double smallest = 0;
    for (int k = 1; k <= n / 2; ++k) {
        const double c = std::cos(2 * pi * k / n);
        smallest = std::min(smallest, 2 * (1 - c) * (1 - 2 * b * (1 + c)) / m);
    }
    return smallest;
}

/// Returns the factor by which a step multiplies the part of the lowest mode, measured over `steps` steps.
double measured_growth(const LaplaceBeltrami& laplacian, const Definiteness& found, double lambda, int steps) {
    const Vector weights = laplacian.M.cwiseProduct(found.bottom.mode);
    Positions X = found.bottom.mode * Eigen::RowVector3d(1, 0, 0);
    const double before = X.col(0).dot(weights);
    for (int t = 0; t < steps; ++t) X = explicit_step(laplacian, lambda, X);
    return std::pow(X.col(0).dot(weights) / before, 1.0 / steps);
}

/// A thin triangle between two wide ones, and a roof over them: the doubled weights of the boundary make opposite-mean indefinite.
TriangleMesh thin_triangle_between_wide_ones(double height) {
    TriangleMesh mesh{Positions(6, 3), Faces(5, 3)};
    mesh.X << 0, 0, 0, 1, 0, 0, 0.5, height, 0, 0, 0.5, 0, 1, 0.5, 0, 0.5, 1.2, 0.1;
    mesh.F << 0, 1, 2, 0, 2, 3, 2, 1, 4, 2, 5, 3, 2, 4, 5;
    return mesh;
}

}   // namespace

TEST(Definiteness, AFamilyWithItsClosedForm) {
    for (const int n : {9, 50, 400, 3000}) {
        for (const double m : {1.0, 1e-9, 1e9}) {
            for (const double b : {0.26, 0.3, 0.5, 2.0}) {
                const double mu = smallest_of_ring(n, b, m);
                const Definiteness found = definiteness(ring_operator(n, b, m));
                EXPECT_LE(found.mu_low, mu * (1 - 1e-12)) << n << ' ' << b;
                EXPECT_GE(found.mu_high, mu * (1 + 1e-12)) << n << ' ' << b;
                EXPECT_EQ(found.indefinite(), mu < 0) << n << ' ' << b;
                if (mu < 0) {
                    EXPECT_NEAR(found.mu_low / found.mu_high, 1, 1e-5) << n << ' ' << b;
                    EXPECT_GE(found.bottom.vertex, 0);
                }
            }
            for (const double b : {0.0, 0.1, 0.2}) {
                const Definiteness found = definiteness(ring_operator(n, b, m));
                EXPECT_TRUE(found.semidefinite()) << n << ' ' << b;
                EXPECT_EQ(found.factorisations > 0, b > 0) << "weights above 0 are evidence enough";
                EXPECT_LE(found.mu_low, 0);
                EXPECT_GE(found.mu_low * m, -1e-13);
            }
        }
    }
}

// 1 + λ|μ_min|, however small λ.
TEST(Definiteness, TheLowestModeGrowsAsPredicted) {
    for (const LaplaceBeltrami& laplacian : {ring_operator(50, 0.3, 1), ring_operator(400, 0.5, 0.01)}) {
        const StabilityCertificate certificate = stability_certificate(laplacian);
        for (const double share : {1e-3, 0.5, 0.9}) {
            const double lambda = share * 2 / certificate.mu_high;
            EXPECT_NEAR(measured_growth(laplacian, certificate.bottom, lambda, 100) / certificate.bottom.growth(lambda), 1, 1e-6);
            EXPECT_GT(certificate.bottom.growth(lambda), 1);
        }
    }
}

TEST(Definiteness, AThinTriangleMakesTheMeanOverOppositeVerticesIndefinite) {
    for (const double height : {0.05, 0.088, 0.1}) {
        const TriangleMesh mesh = thin_triangle_between_wide_ones(height);
        const LaplaceBeltrami laplacian = laplace_operator(mesh, OperatorKind::opposite_mean);
        const StabilityCertificate certificate = stability_certificate(laplacian);
        const double mu = dense_smallest(laplacian);
        ASSERT_LT(mu, -1e-3);
        EXPECT_TRUE(certificate.bottom.indefinite());
        EXPECT_NEAR(certificate.bottom.mu_low / mu, 1, 1e-5);
        EXPECT_NEAR(certificate.bottom.mu_high / mu, 1, 1e-5);
        EXPECT_EQ(certificate.lambda_low(), 0) << "no step is proved stable";
        EXPECT_EQ(certificate.lambda_safe(), 0) << "nor by Gershgorin";
        EXPECT_EQ(certificate.lambda_high(), 0) << "every step is unstable";
        const double lambda = 1 / certificate.mu_high;
        EXPECT_NEAR(measured_growth(laplacian, certificate.bottom, lambda, 50) / certificate.bottom.growth(lambda), 1, 1e-6);
        EXPECT_TRUE(definiteness(laplace_beltrami(mesh)).semidefinite()) << "the finite-element matrix is not to blame";
    }
}

// A semidefinite operator is never called indefinite, and its bound holds, for any shapes and masses.
TEST(Definiteness, SemidefiniteOperatorsAreNeverCalledIndefinite) {
    TriangleMesh needles = irregular_plane(12);
    for (int v = 0; v < needles.vertex_count(); ++v) needles.X(v, 1) *= 1e-6;
    for (const TriangleMesh& mesh :
         {irregular_sphere(2), irregular_plane(12), torus_mesh(16, 9, 1, 0.4), lopsided_ellipsoid(2), cube_mesh(3), needles,
          thin_triangle_between_wide_ones(1e-7), with_unreferenced_vertex(irregular_sphere(1), {0, 50, 0}),
          side_by_side(icosphere(1), moved_by(irregular_sphere(2), {5, 0, 0}))}) {
        for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::uniform, OperatorKind::cotan_no_half, OperatorKind::clamped,
                                        OperatorKind::edge_normalised, OperatorKind::idt, OperatorKind::tufted}) {
            const LaplaceBeltrami laplacian = laplace_operator(mesh, kind);
            for (const Assembly assembly : {assembly_of(kind), Assembly::unknown}) {
                const Definiteness found = definiteness(laplacian, assembly);
                EXPECT_FALSE(found.indefinite()) << operator_entry(kind).name << ' ' << mesh.vertex_count();
                EXPECT_LE(found.mu_low, 0);
                const OperatorWithMass whole = operator_with_mass(laplacian);
                const double mu = dense_smallest({-whole.A, whole.M}), scale = gershgorin_bound(whole.A, whole.M);
                EXPECT_LE(found.mu_low, mu + 1e-13 * scale) << operator_entry(kind).name << ' ' << mesh.vertex_count();
                EXPECT_GE(found.mu_high, mu - 1e-13 * scale);
            }
            EXPECT_TRUE(assembly_of(kind) == Assembly::unknown || definiteness(laplacian, Assembly::triangles).semidefinite())
                << operator_entry(kind).name;
        }
    }
}

TEST(Definiteness, EvidenceIsTheCheapestThatSuffices) {
    const TriangleMesh mesh = irregular_plane(12);
    for (const OperatorKind kind : {OperatorKind::uniform, OperatorKind::clamped, OperatorKind::tufted, OperatorKind::cotan}) {
        const Definiteness found = definiteness(laplace_operator(mesh, kind), assembly_of(kind));
        EXPECT_TRUE(found.semidefinite()) << operator_entry(kind).name;
        EXPECT_EQ(found.factorisations, 0) << operator_entry(kind).name;
    }
    EXPECT_GT(definiteness(laplace_operator(mesh, OperatorKind::cotan)).factorisations, 0) << "some weight is negative here";
}

// A promise about C does not make a matrix semidefinite if its rows do not sum to 0.
TEST(Definiteness, RowsThatSumTooLowAreSeen) {
    LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(2));
    const double scale = laplacian.C.diagonal().cwiseAbs().maxCoeff();
    laplacian.C.coeffRef(7, 7) += 1e-3 * scale;
    EXPECT_TRUE(definiteness(laplacian).indefinite());
    EXPECT_FALSE(definiteness(laplacian, Assembly::triangles).semidefinite());
    laplacian.C.coeffRef(7, 7) -= 2e-3 * scale;   // held fast: no eigenvalue is below 0
    EXPECT_TRUE(definiteness(laplacian).semidefinite());
}

TEST(Definiteness, IsUndecidedWhereTheNegativePartIsRounding) {
    const double b = 0.25 + 1e-13;   // μ_min of the ring is −1e-15 or so
    const Definiteness found = definiteness(ring_operator(400, b, 1));
    EXPECT_FALSE(found.indefinite());
    EXPECT_LE(found.mu_low, smallest_of_ring(400, b, 1));
    EXPECT_GT(found.mu_low, -1e-6);
}

// soundness.md §2: explicit smoothing blows up at half the limit of μ_max.
TEST(Definiteness, TheCamelWithTheMeanOverOppositeVertices) {
    SHARED_MESH_OR_SKIP(mesh, "classic/camel_b.obj");
    const LaplaceBeltrami laplacian = laplace_operator(mesh, OperatorKind::opposite_mean);
    const StabilityCertificate certificate = stability_certificate(laplacian);
    ASSERT_TRUE(certificate.bottom.indefinite());
    EXPECT_NEAR(certificate.bottom.mu_low / certificate.mu_high, -0.0082, 0.00005);
    EXPECT_EQ(certificate.lambda_low(), 0);
    SmoothingOptions options{.laplacian = OperatorKind::opposite_mean, .lambda = 1 / certificate.mu_high, .iterations = 1500};
    const Smoothed run = smooth(mesh, options);
    EXPECT_TRUE(run.blew_up);
    EXPECT_EQ(run.blow_up_vertex, certificate.bottom.bottom.vertex);
}

// The speck's eigenvalues are 10¹² times those of the ring beside it: its rounding is large there.
TEST(Definiteness, ASpeckExcusesNothingBesideIt) {
    const LaplaceBeltrami ring = ring_operator(12, 0.5, 1), speck = ring_operator(12, 0, 1e-12);
    LaplaceBeltrami both{SparseMatrix(24, 24), Vector(24)};
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [part, offset] : {std::pair{&ring, 0}, std::pair{&speck, 12}}) {
        for (int j = 0; j < 12; ++j) {
            for (SparseMatrix::InnerIterator entry(part->C, j); entry; ++entry)
                entries.emplace_back(offset + static_cast<int>(entry.row()), offset + j, entry.value());
        }
        both.M.segment(offset, 12) = part->M;
    }
    both.C.setFromTriplets(entries.begin(), entries.end());
    const Definiteness alone = definiteness(ring), found = definiteness(both);
    ASSERT_TRUE(alone.indefinite());
    EXPECT_TRUE(found.indefinite());
    EXPECT_LT(found.bottom.vertex, 12);
    EXPECT_NEAR(found.mu_high / alone.mu_high, 1, 1e-2);
    EXPECT_TRUE(definiteness(speck).semidefinite());
}

TEST(Definiteness, RefusesMeshesWithoutArea) {
    EXPECT_THROW(definiteness({SparseMatrix(0, 0), Vector(0)}), MeshError);
    EXPECT_THROW(definiteness({SparseMatrix(3, 3), Vector::Zero(3)}), MeshError);
}
