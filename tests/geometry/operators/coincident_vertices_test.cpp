#include "geometry/operators/coincident_vertices.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/smoothing/stability_certificate.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/spectrum_certificate.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

constexpr SmoothingScheme all_schemes[] = {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler, SmoothingScheme::taubin};

/// A new last vertex on the first edge of triangle t, at `offset` from its first end: of the triangles at that edge, each falls into two.
TriangleMesh with_split_edge(const TriangleMesh& mesh, int t, const Vector3& offset) {
    const int a = mesh.F(t, 0), c = mesh.F(t, 1), b = mesh.vertex_count();
    TriangleMesh split = mesh;
    split.X.conservativeResize(b + 1, 3);
    split.X.row(b) = mesh.X.row(a) + offset.transpose();
    for (int s = 0; s < mesh.face_count(); ++s) {
        for (int k = 0; k < 3; ++k) {
            const int from = mesh.F(s, k), to = mesh.F(s, (k + 1) % 3), apex = mesh.F(s, (k + 2) % 3);
            if (!((from == a && to == c) || (from == c && to == a))) continue;
            split.F.row(s) << (from == a ? b : c), (from == a ? c : b), apex;
            split.F.conservativeResize(split.F.rows() + 1, 3);
            split.F.bottomRows(1) << (from == a ? a : b), (from == a ? b : a), apex;
        }
    }
    return split;
}

TriangleMesh regular_tetrahedron() {
    TriangleMesh mesh{Positions(4, 3), Faces(4, 3)};
    mesh.X << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    mesh.F << 3, 2, 0, 0, 1, 3, 1, 2, 3, 0, 2, 1;
    return mesh;
}

std::vector<TriangleMesh> sound_meshes() {
    return {regular_tetrahedron(), irregular_sphere(2), torus_mesh(14, 9, 1, 0.4), irregular_plane(6), fan(7, 0.3)};
}

double pair_distance(const Positions& X, int a) { return (X.row(a) - X.bottomRows(1)).norm(); }

Vector eigenvalues_of(const TriangleMesh& mesh, OperatorKind kind) {
    return smallest_eigenpairs(laplace_operator(mesh, kind), std::min(6, mesh.vertex_count() - 1)).eigenvalues;
}

SmoothingOptions small_steps(const TriangleMesh& mesh, SmoothingScheme scheme, OperatorKind kind) {
    return {.scheme = scheme,
            .laplacian = kind,
            .lambda = 0.3 * largest_stable_step(largest_eigenvalue(laplace_operator(mesh, kind))),
            .iterations = 3};
}

}   // namespace

TEST(CoincidentVertices, SoundMeshesHaveNone) {
    for (const TriangleMesh& mesh : sound_meshes()) {
        EXPECT_TRUE(coincident_vertices(mesh).empty());
        EXPECT_TRUE(coincident_vertices(scaled(mesh, 1e-200)).empty());
        EXPECT_TRUE(coincident_vertices(scaled(mesh, 1e100)).empty());
        TriangleMesh seam = mesh;   // the same points, but no edge joins them
        seam.X.conservativeResize(2 * mesh.X.rows(), 3);
        seam.X.bottomRows(mesh.X.rows()) = mesh.X;
        seam.F.conservativeResize(2 * mesh.F.rows(), 3);
        seam.F.bottomRows(mesh.F.rows()) = mesh.F.array() + mesh.vertex_count();
        EXPECT_TRUE(coincident_vertices(seam).empty());
    }
}

// The operator of the mesh in which the two are one: the new vertex has no row.
TEST(CoincidentVertices, HaveOneRowOfEveryOperator) {
    for (const TriangleMesh& mesh : sound_meshes()) {
        const TriangleMesh split = with_split_edge(mesh, 1, Vector3::Zero());
        for (const OperatorEntry& entry : operator_list()) {
            SCOPED_TRACE(std::string(entry.name) + " on " + std::to_string(mesh.vertex_count()));
            const OperatorWithMass one = operator_with_mass(laplace_operator(mesh, entry.kind));
            const OperatorWithMass two = operator_with_mass(laplace_operator(split, entry.kind));
            ASSERT_EQ(two.size(), one.size());
            EXPECT_EQ(two.all_vertices, one.all_vertices + 1);
            EXPECT_LE((DenseMatrix(two.A) - DenseMatrix(one.A)).norm(), 1e-12 * DenseMatrix(one.A).norm());
            EXPECT_LE((two.M - one.M).norm(), 1e-12 * one.M.norm());
        }
    }
}

TEST(CoincidentVertices, HaveOneMotionAndOneModeValue) {
    for (const TriangleMesh& mesh : sound_meshes()) {
        const TriangleMesh split = with_split_edge(mesh, 1, Vector3::Zero());
        const int a = mesh.F(1, 0);
        for (const OperatorEntry& entry : operator_list()) {
            SCOPED_TRACE(std::string(entry.name) + " on " + std::to_string(mesh.vertex_count()));
            const LaplaceBeltrami laplacian = laplace_operator(split, entry.kind);
            const Spectrum modes = smallest_eigenpairs(laplacian, 4);
            EXPECT_EQ(modes.eigenvectors.row(a), modes.eigenvectors.bottomRows(1));
            EXPECT_LT(orthonormality_error(modes, laplacian.M), 1e-9);
            EXPECT_EQ(certify_spectrum(split, laplacian, modes).verdict(), Proof::proved);
            const Positions rebuilt = reconstruct(modes, laplacian.M, split.X, 4);
            EXPECT_EQ(pair_distance(rebuilt, a), 0);
            for (const SmoothingScheme scheme : all_schemes) {
                for (const bool rebuild : {false, true}) {
                    SmoothingOptions options = small_steps(mesh, scheme, entry.kind);
                    options.rebuild = rebuild;
                    const Positions X = smooth(split, options).X;
                    EXPECT_EQ(pair_distance(X, a), 0);
                    EXPECT_LT((X.topRows(mesh.vertex_count()) - smooth(mesh, options).X).cwiseAbs().maxCoeff(), 1e-9);
                }
            }
        }
    }
}

TEST(CoincidentVertices, HaveTheLimitAndTheCurvatureOfOnePoint) {
    const TriangleMesh mesh = irregular_sphere(2), split = with_split_edge(mesh, 5, Vector3::Zero());
    const MeshTopology topology = topology_of(mesh), of_split = topology_of(split);
    const int n = mesh.vertex_count(), a = mesh.F(5, 0);
    const auto expect_spread = [&](const Vector& values, const Vector& right) {
        EXPECT_LT((values.head(n) - right).cwiseAbs().maxCoeff(), 1e-10 * right.cwiseAbs().maxCoeff());
        EXPECT_EQ(values[n], values[a]);
    };
    const LaplaceBeltrami one = laplace_beltrami(mesh), two = laplace_beltrami(split);
    expect_spread(cotangent_mean_curvature(split, of_split, two), cotangent_mean_curvature(mesh, topology, one));
    expect_spread(uniform_mean_curvature(split, of_split), uniform_mean_curvature(mesh, topology));
    expect_spread(uniform_mean_curvature_scaled(split, of_split), uniform_mean_curvature_scaled(mesh, topology));
    expect_spread(gaussian_curvature(split, of_split, two.M), gaussian_curvature(mesh, topology, one.M));
    expect_spread(jet_curvature(split, of_split).H, jet_curvature(mesh, topology).H);
    EXPECT_NEAR(angle_deficit(split, of_split).sum(), 4 * pi, 1e-10);
    EXPECT_DOUBLE_EQ(stability_certificate(two).mu_high, stability_certificate(one).mu_high);
    EXPECT_NEAR(two.M.sum(), one.M.sum(), 1e-12);
}

// Eigenvalues and steps tend to those of one point as the gap closes, from every side. The uniform operator sees no gap; clamped weights
// and areas by edge tend to values that depend on the side.
TEST(CoincidentVertices, AreTheLimitOfAClosingGap) {
    for (const TriangleMesh& mesh : {regular_tetrahedron(), irregular_sphere(2), irregular_plane(6)}) {
        const int a = mesh.F(1, 0), c = mesh.F(1, 1);
        const Vector3 along = (mesh.X.row(c) - mesh.X.row(a)).normalized();
        for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::cotan_no_half, OperatorKind::idt, OperatorKind::tufted}) {
            const Vector closed = eigenvalues_of(mesh, kind);
            const SmoothingOptions options = small_steps(mesh, SmoothingScheme::implicit_euler, kind);
            const Positions smoothed = smooth(mesh, options).X;
            for (const Vector3& side : {along, Vector3(0.6, 0, 0.8), Vector3(-0.48, 0.8, 0.36)}) {
                for (int digits = 6; digits <= 15; ++digits) {
                    SCOPED_TRACE(std::string(operator_entry(kind).name) + ", gap 1e-" + std::to_string(digits));
                    const TriangleMesh open = with_split_edge(mesh, 1, std::pow(10, -digits) * side);
                    EXPECT_LT((eigenvalues_of(open, kind) - closed).cwiseAbs().maxCoeff(), 1e-5 * closed.maxCoeff());
                    const Positions X = smooth(open, options).X;
                    EXPECT_LT(pair_distance(X, a), 2e-6);
                    EXPECT_LT((X.topRows(mesh.vertex_count()) - smoothed).cwiseAbs().maxCoeff(), 2e-5);
                }
            }
        }
    }
}

TEST(CoincidentVertices, OfATetrahedronHaveItsEigenvalues) {
    const TriangleMesh split = with_split_edge(regular_tetrahedron(), 0, Vector3::Zero());
    const Vector mu = eigenvalues_of(split, OperatorKind::cotan);
    ASSERT_EQ(mu.size(), 4);
    EXPECT_EQ(mu[0], 0);
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(mu[i], 2.0 / 3, 1e-14);
    EXPECT_NEAR(eigenvalues_of(split, OperatorKind::uniform)[3], 4.0 / 3, 1e-14) << "three neighbours each";
}

TEST(CoincidentVertices, FormClassesOverChainsAndLoops) {
    TriangleMesh mesh = with_split_edge(irregular_sphere(1), 1, Vector3::Zero());
    const int a = irregular_sphere(1).F(1, 0);
    for (int more = 0; more < 3; ++more) mesh = with_split_edge(mesh, mesh.face_count() - 1, Vector3::Zero());   // edges of the class
    const std::vector<VertexCopy> copies = coincident_vertices(mesh);
    ASSERT_EQ(copies.size(), 4U);
    for (const VertexCopy& copy : copies) {
        EXPECT_EQ(copy.of, a);
        EXPECT_EQ(mesh.X.row(copy.vertex), mesh.X.row(a));
    }
    EXPECT_LT((eigenvalues_of(mesh, OperatorKind::cotan) - eigenvalues_of(irregular_sphere(1), OperatorKind::cotan)).norm(), 1e-10);
}

/// A whole component of one point, a boundary edge without length, three books at one edge without length, far away or hair apart.
TEST(CoincidentVertices, OfAnyKindLeaveFiniteNumbers) {
    TriangleMesh point = irregular_sphere(1);   // beside it, a tetrahedron of one point
    const int n = point.vertex_count();
    point.X.conservativeResize(n + 4, 3);
    point.X.bottomRows(4).rowwise() = Eigen::RowVector3d(3, 3, 3);
    point.F.conservativeResize(point.F.rows() + 4, 3);
    point.F.bottomRows(4) = regular_tetrahedron().F.array() + n;
    TriangleMesh book{Positions(5, 3), Faces(3, 3)};
    book.X << 0, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, -1, -1, 0.5;
    book.F << 0, 1, 2, 0, 1, 3, 1, 0, 4;
    TriangleMesh pages = irregular_plane(5);
    const int first = pages.vertex_count();
    pages.X.conservativeResize(first + 5, 3);
    pages.X.bottomRows(5) = book.X.rowwise() + Eigen::RowVector3d(0, 0, 2);
    pages.F.conservativeResize(pages.F.rows() + 3, 3);
    pages.F.bottomRows(3) = book.F.array() + first;
    TriangleMesh away = with_split_edge(irregular_sphere(1), 1, Vector3::Zero());
    away.X.rowwise() += Eigen::RowVector3d(1e7, -1e7, 1e7);
    const TriangleMesh hair = with_split_edge(fan(6, 0.2), 0, Vector3(0, 0, 1e-300));
    for (const TriangleMesh& mesh : {point, pages, away, hair, with_split_edge(fan(6), 1, Vector3::Zero())}) {
        EXPECT_FALSE(coincident_vertices(mesh).empty());
        for (const OperatorEntry& entry : operator_list()) {
            SCOPED_TRACE(std::string(entry.name) + " on " + std::to_string(mesh.vertex_count()));
            const LaplaceBeltrami laplacian = laplace_operator(mesh, entry.kind);
            EXPECT_TRUE(smallest_eigenpairs(laplacian, 5).eigenvectors.allFinite());
            for (const SmoothingScheme scheme : all_schemes) {
                const SmoothingOptions options = small_steps(mesh, scheme, entry.kind);
                const Positions X = smooth(mesh, options).X;
                EXPECT_TRUE(X.allFinite());
                for (const VertexCopy& copy : laplacian.copies) EXPECT_EQ(X.row(copy.vertex), X.row(copy.of));
            }
        }
    }
}
