#include "geometry/spectrum/spectral_reconstruction.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

struct Decomposed {
    TriangleMesh mesh;
    Vector M;
    Spectrum spectrum;
    explicit Decomposed(TriangleMesh m, int k = 100'000) : mesh(std::move(m)) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        M = laplacian.M;
        spectrum = smallest_eigenpairs(laplacian, k);
    }
    Positions at(int k) const { return reconstruct(spectrum, M, mesh.X, k); }
    double weighted_rms(const Positions& X) const { return std::sqrt(M.dot((X - mesh.X).rowwise().squaredNorm()) / M.sum()); }
};

/// Returns an icosahedron with this area at each vertex. Its eigenvalues have the multiplicities 1, 3, 5, 3.
TriangleMesh icosahedron_of(double area) {
    const TriangleMesh mesh = icosphere(0);
    return scaled(mesh, std::sqrt(12 * area / surface_area(mesh)));
}
const std::vector<int> whole_clusters{1, 4, 9, 12};

}   // namespace

TEST(SpectralReconstruction, ErrorFromCoefficientsIsTheErrorOfTheMesh) {
    for (const int modes : {40, 100'000}) {
        const Decomposed d(side_by_side(lopsided_ellipsoid(2), moved_by(cube_mesh(3), {4, 1, 0})), modes);
        const Vector rms = reconstruction_rms(d.spectrum, d.M, d.mesh.X);
        ASSERT_EQ(rms.size(), d.spectrum.eigenvalues.size() + 1);
        for (int k = 0; k < rms.size(); ++k) EXPECT_NEAR(rms[k], d.weighted_rms(d.at(k)), 1e-13 * rms[0]) << "k = " << k;
        for (int k = 1; k < rms.size(); ++k) EXPECT_LE(rms[k], rms[k - 1]);
    }
}

// Modes that come in blocks, as from slices of a spectrum, are summed as they come.
TEST(SpectralReconstruction, AStreamOfBlocksIsTheSameAsAllModesAtOnce) {
    const Decomposed d(with_unreferenced_vertex(moved_by(side_by_side(lopsided_ellipsoid(1), cube_mesh(2)), {30, -20, 5}), {7, 8, 9}));
    const int n = static_cast<int>(d.spectrum.eigenvalues.size());
    ReconstructionStream stream(d.M, d.mesh.X);
    EXPECT_EQ(stream.positions().bottomRows(n).cwiseAbs().maxCoeff(), 0);
    for (const int k : {1, 2, 9, 30, n}) {   // the first block ends between the zero modes of the two components
        const int done = stream.modes();
        stream.add(d.spectrum.eigenvectors.middleCols(done, k - done), d.spectrum.eigenvalues.segment(done, k - done));
        ASSERT_EQ(stream.modes(), k);
        EXPECT_LT((stream.positions() - d.at(k)).cwiseAbs().maxCoeff(), 1e-13) << "k = " << k;
        const Vector rms = stream.rms();
        ASSERT_EQ(rms.size(), k + 1);
        for (int j = 0; j <= k; ++j) EXPECT_NEAR(rms[j], d.weighted_rms(d.at(j)), 1e-13 * rms[0]);
    }
    EXPECT_THROW(stream.add(DenseMatrix::Zero(5, 1), Vector::Zero(1)), MeshError);
    EXPECT_THROW(ReconstructionStream(d.M, icosphere(0).X), MeshError);
}

// ‖X‖²_M = Σ |ĉ|² over all modes.
TEST(SpectralReconstruction, ParsevalOverAllModes) {
    const Decomposed d(irregular_sphere(2));
    const double energy = d.M.dot(d.mesh.X.rowwise().squaredNorm());
    EXPECT_NEAR(spectral_coefficients(d.spectrum, d.M, d.mesh.X).squaredNorm() / energy, 1, 1e-12);
}

TEST(SpectralReconstruction, AllModesGiveTheMeshBack) {
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(1e7, -1e7, 3e6)}) {
        const Decomposed d(with_unreferenced_vertex(moved_by(lopsided_ellipsoid(2), offset), {7, 8, 9}));
        const int n = d.mesh.vertex_count() - 1;
        ASSERT_EQ(d.spectrum.eigenvalues.size(), n);
        EXPECT_LT((d.at(n) - d.mesh.X).cwiseAbs().maxCoeff(), 1e-12 + 4e-16 * offset.norm());
        EXPECT_LT(reconstruction_rms(d.spectrum, d.M, d.mesh.X)[n], 1e-12 + 4e-16 * offset.norm());
    }
}

TEST(SpectralReconstruction, IsAnOrthogonalProjection) {
    const Decomposed d(lopsided_ellipsoid(2), 60);
    for (const int k : {1, 5, 33, 60}) {
        const Positions X_k = d.at(k);
        EXPECT_LT((reconstruct(d.spectrum, d.M, X_k, k) - X_k).cwiseAbs().maxCoeff(), 1e-13) << "twice is once";
        const auto Phi = d.spectrum.eigenvectors.leftCols(k);
        EXPECT_LT((Phi.transpose() * (d.M.asDiagonal() * (d.mesh.X - X_k))).cwiseAbs().maxCoeff(), 1e-13)
            << "the error has no part in the span";
    }
}

TEST(SpectralReconstruction, OneModeOfAConnectedMeshIsItsCentreOfMass) {
    const Decomposed d(lopsided_ellipsoid(2), 5);
    const Eigen::RowVector3d centre = d.M.transpose() * d.mesh.X / d.M.sum();
    EXPECT_LT((d.at(1).rowwise() - centre).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(d.at(0).cwiseAbs().maxCoeff(), 0);
}

TEST(SpectralReconstruction, MovesWithTheMesh) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const Decomposed d(mesh, 25);
    const TriangleMesh moved = rotated_and_moved(mesh);
    const Positions expected = rotated_and_moved({d.at(25), mesh.F}).X;
    EXPECT_LT((reconstruct(d.spectrum, d.M, moved.X, 25) - expected).cwiseAbs().maxCoeff(), 1e-12);
    const Vector3 far(1e7, 1e7, -1e7);
    const Positions there = reconstruct(d.spectrum, d.M, moved_by(mesh, far).X, 25);
    EXPECT_LT(((there.rowwise() - far.transpose()) - d.at(25)).cwiseAbs().maxCoeff(), 2e-8)
        << "not more than the coordinates' own rounding";
}

TEST(SpectralReconstruction, UnreferencedVerticesStay) {
    const Decomposed d(with_unreferenced_vertex(icosphere(2), {7, 8, 9}), 10);
    EXPECT_EQ(d.at(10).row(0), d.mesh.X.row(0));
    EXPECT_LT(reconstruction_rms(d.spectrum, d.M, d.mesh.X)[10], 2) << "and do not count as error";
}

TEST(SpectralReconstruction, RefusesMoreModesThanThereAre) {
    const Decomposed d(icosphere(1), 10);
    EXPECT_THROW(d.at(11), MeshError);
    EXPECT_THROW(d.at(-1), MeshError);
    EXPECT_THROW(reconstruct(d.spectrum, d.M, icosphere(2).X, 3), MeshError);
}

// Area-weighted rms in % of the box diagonal.
TEST(SpectralReconstruction, ErrorsOfTheAssignmentsArmadillo) {
    SHARED_MESH_OR_SKIP(mesh, "coursework/decompose/armadillo.obj");
    const Decomposed d(mesh);
    const Vector rms = reconstruction_rms(d.spectrum, d.M, mesh.X);
    const double percent = 100 / bounding_box(mesh).diagonal();
    const std::vector<std::pair<int, double>> measured = {{5, 8.50}, {10, 4.92}, {15, 3.53}, {30, 2.42}, {60, 1.02}, {150, 0.58}};
    for (const auto& [k, expected] : measured) {
        const double over_vertices = std::sqrt((d.at(k) - mesh.X).squaredNorm() / mesh.vertex_count());
        EXPECT_NEAR(percent * over_vertices, expected, 0.006) << "k = " << k << ", area-weighted " << percent * rms[k];
    }
    EXPECT_LT(percent * rms[361], 1e-11);
}

TEST(SpectralMistakes, EqualAreasHideTheMissingMapping) {
    for (const double area : {1.0, 0.037}) {
        const TriangleMesh mesh = moved_by(icosahedron_of(area), {1, 2, 3});
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 12);
        for (const int k : whole_clusters) {
            const Positions right = reconstruct(spectrum, laplacian.M, mesh.X, k);
            EXPECT_LT(largest_difference(reconstruct_unmapped(spectrum, laplacian.M, mesh.X, k), right), 1e-12);
            EXPECT_LT(largest_difference(area * reconstruct_unweighted(spectrum, laplacian.M, mesh.X, k), right), 1e-12)
                << "off by the area, and by nothing where that is 1";
        }
    }
}

TEST(SpectralMistakes, EqualAreasHideTheEdgeNormalisedOperator) {
    const TriangleMesh mesh = moved_by(icosahedron_of(0.4), {1, 2, 3});
    const LaplaceBeltrami right = laplace_beltrami(mesh), other = laplace_operator(mesh, OperatorKind::edge_normalised);
    const Spectrum spectrum = smallest_eigenpairs(right, 12), others = smallest_eigenpairs(other, 12);
    EXPECT_LT(largest_relative_difference(others.eigenvalues, spectrum.eigenvalues), 1e-12);
    for (const int k : whole_clusters) {
        EXPECT_LT(largest_difference(reconstruct(others, other.M, mesh.X, k), reconstruct(spectrum, right.M, mesh.X, k)), 1e-12);
    }
}

TEST(SpectralMistakes, UnequalAreasShowThem) {
    const TriangleMesh mesh = moved_by(lopsided_ellipsoid(2), {1, 2, 3});
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 30);
    for (const int k : {4, 30}) {
        const double right = vertex_rms(mesh.X, reconstruct(spectrum, laplacian.M, mesh.X, k));
        EXPECT_GT(vertex_rms(mesh.X, reconstruct_unmapped(spectrum, laplacian.M, mesh.X, k)), 1.2 * right);
        EXPECT_GT(vertex_rms(mesh.X, reconstruct_unweighted(spectrum, laplacian.M, mesh.X, k)), 10 * right);
    }
}

// The right way moves with the mesh; the mistakes do not, for a constant is no longer among their modes.
TEST(SpectralMistakes, DependOnTheOrigin) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 10);
    const Eigen::RowVector3d offset(10, 0, 0);
    const auto moves = [&](auto rebuild) {
        const Positions there = rebuild(spectrum, laplacian.M, Positions(mesh.X.rowwise() + offset), 10);
        return largest_difference(there.rowwise() - offset, rebuild(spectrum, laplacian.M, mesh.X, 10));
    };
    EXPECT_LT(moves(reconstruct), 1e-12);
    EXPECT_GT(moves(reconstruct_unmapped), 0.1);
    EXPECT_GT(moves(reconstruct_unweighted), 0.1);
}

TEST(SpectralMistakes, AllUnmappedModesAreABasisAllTheSame) {
    const TriangleMesh mesh = with_unreferenced_vertex(lopsided_ellipsoid(1), {7, 8, 9});
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 1000);
    const int n = static_cast<int>(spectrum.eigenvalues.size());
    EXPECT_LT(largest_difference(reconstruct_unmapped(spectrum, laplacian.M, mesh.X, n), mesh.X), 1e-12);
    EXPECT_THROW(reconstruct_unmapped(spectrum, laplacian.M, mesh.X, n + 1), MeshError);
    EXPECT_THROW(reconstruct_unweighted(spectrum, laplacian.M, icosphere(2).X, 1), MeshError);
}

// rms over the vertices in % of the box diagonal; the report on which the operator was found gives 3.50 and 1.18.
TEST(SpectralMistakes, ErrorsOfTheAssignmentsArmadillo) {
    SHARED_MESH_OR_SKIP(mesh, "coursework/decompose/armadillo.obj");
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh), other = laplace_operator(mesh, OperatorKind::edge_normalised);
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 361), others = smallest_eigenpairs(other, 361);
    const double percent = 100 / bounding_box(mesh).diagonal();
    const auto rms = [&](const Positions& X) { return percent * vertex_rms(mesh.X, X); };
    EXPECT_NEAR(rms(reconstruct_unmapped(spectrum, laplacian.M, mesh.X, 15)), 6.00, 0.006);
    EXPECT_NEAR(rms(reconstruct(others, other.M, mesh.X, 15)), 3.50, 0.006);
    EXPECT_NEAR(rms(reconstruct(others, other.M, mesh.X, 60)), 1.18, 0.006);
    for (const int k : {1, 5, 15, 60, 150, 361}) EXPECT_GT(rms(reconstruct_unweighted(spectrum, laplacian.M, mesh.X, k)), 600) << k;
}
