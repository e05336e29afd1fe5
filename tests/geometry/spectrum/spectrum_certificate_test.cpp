#include "geometry/spectrum/spectrum_certificate.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <tuple>

#include "base/errors.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

struct Solved {
    TriangleMesh mesh;
    LaplaceBeltrami laplacian;
    Spectrum spectrum;
    SpectrumCertificate certificate() const { return certify_spectrum(mesh, laplacian, spectrum); }
};

Solved solved(const TriangleMesh& mesh, int k) {
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    return {mesh, laplacian, smallest_eigenpairs(laplacian, k)};
}

void drop_mode(Spectrum& spectrum, Eigen::Index j) {
    const Eigen::Index rest = spectrum.eigenvalues.size() - j - 1;
    spectrum.eigenvalues.segment(j, rest) = spectrum.eigenvalues.tail(rest).eval();
    spectrum.eigenvectors.middleCols(j, rest) = spectrum.eigenvectors.rightCols(rest).eval();
    spectrum.eigenvalues.conservativeResize(j + rest);
    spectrum.eigenvectors.conservativeResize(Eigen::NoChange, j + rest);
}

/// A spectrum as another program might hand it over: without any claim of its own.
Spectrum without_claims(Spectrum spectrum) {
    spectrum.residuals = {};
    spectrum.gap_middle = 0;
    return spectrum;
}

}   // namespace

TEST(SpectrumCertificate, HoldsForDenseAndSparseSolves) {
    for (const int level : {2, 4}) {
        const Solved s = solved(lopsided_ellipsoid(level), 12);
        EXPECT_EQ(s.spectrum.dense, level == 2);
        const SpectrumCertificate c = s.certificate();
        EXPECT_TRUE(c.holds()) << c.residual << " " << c.orthonormality_error << " " << c.parseval_gap << " " << c.counted_below;
        EXPECT_EQ(c.counted_below, 12);   // no two eigenvalues are equal: σ lies above all
        EXPECT_GT(c.shift, s.spectrum.eigenvalues[11]);
        EXPECT_EQ(c.zero_eigenvalues, 1);
        EXPECT_EQ(c.residual_limit, 1e-8);
    }
}

TEST(SpectrumCertificate, IgnoresClaimsOfTheSolver) {
    Solved s = solved(lopsided_ellipsoid(3), 9);
    const SpectrumCertificate with = s.certificate();
    s.spectrum = without_claims(s.spectrum);
    const SpectrumCertificate without = s.certificate();
    EXPECT_TRUE(with.holds() && without.holds());   // σ is found without a hint, too
    EXPECT_EQ(with.found_below, without.found_below);
    EXPECT_EQ(with.residual, without.residual);
    for (const double hint : {-1.0, 1e-3, 1e3, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        s.spectrum.gap_middle = hint * s.spectrum.eigenvalues[8];   // a wrong one proves nothing that is not so
        const SpectrumCertificate c = s.certificate();
        EXPECT_NE(c.complete, Proof::refuted) << hint;
        EXPECT_TRUE(c.complete != Proof::proved || c.counted_below == c.found_below);
    }
}

// No vector, no residual, a count of rounding: the words for it.
// Beside a stiff edge rounding of the operator would allow any residual. Two modes turned into each other by 10⁻³ are still not those of
// the operator.
TEST(SpectrumCertificate, ALargeResidualIsNeverProvedWhateverTheNorm) {
    for (const double stiffness : {1e8, 1e10, 1e11, 1e12}) {
        Solved s = solved(irregular_plane(12), 10);
        s.laplacian.C.coeffRef(0, 1) += stiffness;
        s.laplacian.C.coeffRef(1, 0) += stiffness;
        s.laplacian.C.coeffRef(0, 0) -= stiffness;
        s.laplacian.C.coeffRef(1, 1) -= stiffness;
        s.spectrum = smallest_eigenpairs(s.laplacian, 10);
        const Vector fifth = s.spectrum.eigenvectors.col(5), sixth = s.spectrum.eigenvectors.col(6);
        s.spectrum.eigenvectors.col(5) = std::cos(1e-3) * fifth + std::sin(1e-3) * sixth;
        s.spectrum.eigenvectors.col(6) = std::cos(1e-3) * sixth - std::sin(1e-3) * fifth;
        EXPECT_NE(s.certificate().verdict(), Proof::proved) << stiffness;
    }
}

TEST(SpectrumCertificate, ValuesHiddenByRoundingAreUndecided) {
    Solved s = solved(lopsided_ellipsoid(2), 12);
    const SpectrumCertificate sound = s.certificate();
    ASSERT_EQ(sound.complete, Proof::proved);
    EXPECT_LT(sound.delta, 1e-3 * sound.gap);
    // Wrong vectors of right values: below σ there are as many as found, but the pairs do not prove it.
    s.spectrum.eigenvectors.col(5) += 0.3 * s.spectrum.eigenvectors.col(6);
    EXPECT_NE(s.certificate().complete, Proof::refuted);
    EXPECT_EQ(s.certificate().verdict(), Proof::refuted) << "its residual is beyond its limit";
    // A triangle without area that has kept a weight: it swallows twelve digits.
    Solved flat = solved(lopsided_ellipsoid(2), 12);
    for (const auto& [i, j, w] : {std::tuple{0, 40, 2e12}, std::tuple{40, 80, 2e12}, std::tuple{0, 80, -1e12}}) {
        flat.laplacian.C.coeffRef(i, j) += w;
        flat.laplacian.C.coeffRef(j, i) += w;
        flat.laplacian.C.coeffRef(i, i) -= w;
        flat.laplacian.C.coeffRef(j, j) -= w;
    }
    flat.spectrum.gap_middle = 0;
    EXPECT_NE(flat.certificate().complete, Proof::proved);
    EXPECT_GT(flat.certificate().delta, 1e-6);
}

// A mesh held together by a triangle without area only has two components.
TEST(SpectrumCertificate, ATriangleWithoutAreaHoldsNothingTogether) {
    TriangleMesh mesh = side_by_side(icosphere(1), moved_by(icosphere(1), {4, 0, 0}));
    const int left = 0, right = mesh.vertex_count() / 2;
    mesh.F.conservativeResize(mesh.F.rows() + 1, 3);
    mesh.F.bottomRows(1) << left, right, left;
    EXPECT_EQ(solved(side_by_side(icosphere(1), moved_by(icosphere(1), {4, 0, 0})), 6).certificate().expected_zeros, 2);
    Solved s = solved(side_by_side(icosphere(1), moved_by(icosphere(1), {4, 0, 0})), 6);
    s.mesh = mesh;
    EXPECT_EQ(s.certificate().expected_zeros, 2);
}

TEST(SpectrumCertificate, EveryModeOfAClosedAndAnOpenMesh) {
    for (const TriangleMesh& mesh : {lopsided_ellipsoid(2), irregular_plane(9)}) {
        const SpectrumCertificate c = solved(mesh, mesh.vertex_count()).certificate();
        EXPECT_TRUE(c.holds()) << c.residual << " " << c.orthonormality_error << " " << c.parseval_gap;
        EXPECT_EQ(c.counted_below, mesh.vertex_count());
    }
}

// k = 6 cuts the five-fold eigenvalue l = 2 of the sphere: proved is what lies below it.
TEST(SpectrumCertificate, ACutClusterIsProvedUpToTheCluster) {
    const SpectrumCertificate c = solved(icosphere(3), 6).certificate();
    EXPECT_TRUE(c.holds());
    EXPECT_EQ(c.counted_below, 4);
    EXPECT_EQ(c.found_below, 4);
    const SpectrumCertificate whole = solved(icosphere(3), 9).certificate();
    EXPECT_TRUE(whole.holds());
    EXPECT_EQ(whole.counted_below, 9);
}

// A σ just below the given value would lie above the eigenvalue: an eigenvalue counted there is not missing.
TEST(SpectrumCertificate, AValueThatIsALittleOffMissesNothing) {
    Solved s = solved(icosphere(3), 6);
    s.spectrum.eigenvalues.tail(2) *= 1 + 1e-4;
    EXPECT_NE(s.certificate().complete, Proof::refuted);
    EXPECT_EQ(s.certificate().verdict(), Proof::refuted) << "its residual tells of it";
}

TEST(SpectrumCertificate, ADroppedModeIsMissedWhicheverItIs) {
    const Solved s = solved(lopsided_ellipsoid(3), 10);
    for (const Eigen::Index j : {0, 1, 4, 8}) {
        Solved damaged = s;
        drop_mode(damaged.spectrum, j);
        const SpectrumCertificate c = damaged.certificate();
        EXPECT_EQ(c.complete, Proof::refuted) << j;
        EXPECT_EQ(c.counted_below, c.found_below + 1) << j;
        EXPECT_LT(c.residual, 1e-8);   // what is left is right
        EXPECT_LT(c.orthonormality_error, 1e-9);
    }
    Solved shorter = s;
    drop_mode(shorter.spectrum, 9);   // the last one: the rest are the nine smallest
    EXPECT_TRUE(shorter.certificate().holds());
}

TEST(SpectrumCertificate, OneOfAMultipletDroppedIsMissed) {
    Solved s = solved(icosphere(3), 9);
    drop_mode(s.spectrum, 2);   // l = 1 is threefold
    EXPECT_EQ(s.certificate().complete, Proof::refuted);
}

TEST(SpectrumCertificate, WrongVectorsAreSeen) {
    const Solved s = solved(lopsided_ellipsoid(3), 8);
    Solved replaced = s;
    replaced.spectrum.eigenvectors.col(5) = s.spectrum.eigenvectors.col(4);
    EXPECT_GT(replaced.certificate().residual, 1e-3);
    EXPECT_NEAR(replaced.certificate().orthonormality_error, 1, 1e-6);
    Solved not_mapped_back = s;   // ψ = M^½φ in place of φ
    not_mapped_back.spectrum.eigenvectors.col(5) = s.laplacian.M.cwiseSqrt().cwiseProduct(s.spectrum.eigenvectors.col(5));
    EXPECT_GT(not_mapped_back.certificate().residual, 1e-3);
    EXPECT_GT(not_mapped_back.certificate().orthonormality_error, 1e-3);
    Solved twice_as_long = s;
    twice_as_long.spectrum.eigenvectors.col(3) *= 2;
    EXPECT_LT(twice_as_long.certificate().residual, 1e-8);
    EXPECT_NEAR(twice_as_long.certificate().orthonormality_error, 3, 1e-6);
    EXPECT_GT(twice_as_long.certificate().parseval_gap, 1e-9);
}

TEST(SpectrumCertificate, WrongValuesAreSeen) {
    const Solved s = solved(lopsided_ellipsoid(3), 8);
    Solved off = s;
    off.spectrum.eigenvalues[5] *= 1 + 1e-6;
    EXPECT_FALSE(off.certificate().holds());
    Solved turned = s;
    std::swap(turned.spectrum.eigenvalues[4], turned.spectrum.eigenvalues[5]);
    turned.spectrum.eigenvectors.col(4).swap(turned.spectrum.eigenvectors.col(5));
    EXPECT_LT(turned.certificate().residual, 1e-8);
    EXPECT_LT(turned.certificate().smallest_step_up, 0);
    EXPECT_FALSE(turned.certificate().holds());
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Solved broken = s;
        broken.spectrum.eigenvalues[3] = bad;
        EXPECT_FALSE(broken.certificate().holds());
        broken = s;
        broken.spectrum.eigenvectors(7, 3) = bad;
        EXPECT_FALSE(broken.certificate().holds());
        EXPECT_EQ(broken.certificate().residual, std::numeric_limits<double>::infinity());
    }
}

TEST(SpectrumCertificate, ZerosAreCountedFromTheTriangles) {
    const TriangleMesh two = side_by_side(icosphere(2), moved_by(lopsided_ellipsoid(2), {5, 0, 0}));
    const Solved s = solved(two, 7);
    EXPECT_EQ(s.certificate().expected_zeros, 2);
    EXPECT_EQ(s.certificate().zero_eigenvalues, 2);
    EXPECT_TRUE(s.certificate().holds());
    Solved cut = s;   // as a solver that knows one constant only would have it
    drop_mode(cut.spectrum, 1);
    EXPECT_EQ(cut.certificate().zero_eigenvalues, 1);
    EXPECT_EQ(cut.certificate().expected_zeros, 2);
    EXPECT_FALSE(cut.certificate().holds());
    EXPECT_EQ(solved(two, 1).certificate().expected_zeros, 1);   // k is too small for both
    EXPECT_TRUE(solved(two, 1).certificate().holds());
    EXPECT_TRUE(solved(two, 1).certificate().says_nothing());   // of two zeros, one was asked for
    EXPECT_FALSE(s.certificate().says_nothing());
    EXPECT_EQ(solved(with_unreferenced_vertex(icosphere(2), {9, 9, 9}), 5).certificate().expected_zeros, 1);
}

// Zeros are judged in the unit of their component: edge-normalised weights grow with the size of a component.
TEST(SpectrumCertificate, ZerosAreCountedOnComponentsOfAnySize) {
    const TriangleMesh ball = icosphere(1);
    const TriangleMesh three = side_by_side(side_by_side(ball, scaled(ball, 1e-12)), moved_by(scaled(ball, 1e9), Vector3::Constant(3e9)));
    const LaplaceBeltrami laplacian = laplace_operator(three, OperatorKind::edge_normalised);
    const SpectrumCertificate c = certify_spectrum(three, laplacian, smallest_eigenpairs(laplacian, 8));
    EXPECT_EQ(c.zero_eigenvalues, 3);
    EXPECT_NE(c.verdict(), Proof::refuted);
}

// π²/L² of a strip 10⁷ times as long as wide is below the rounding of its operator: no failure, but a vector that is no zero mode is one.
TEST(SpectrumCertificate, ZerosHiddenByRoundingAreUndecided) {
    const TriangleMesh strip = grid_mesh(40, 2, 1e7, 1);
    const LaplaceBeltrami laplacian = laplace_beltrami(strip);
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> dense(DenseMatrix(symmetric_form(whole.A, whole.M)));   // reads the lower triangle
    Spectrum spectrum;
    spectrum.eigenvalues = dense.eigenvalues();
    spectrum.eigenvectors = whole.M.cwiseSqrt().cwiseInverse().asDiagonal() * dense.eigenvectors();
    const SpectrumCertificate c = certify_spectrum(strip, laplacian, spectrum);
    EXPECT_GT(c.zero_eigenvalues, 1);
    EXPECT_TRUE(c.zeros_undecided);
    const Solved sound = solved(lopsided_ellipsoid(2), 8);
    EXPECT_FALSE(sound.certificate().zeros_undecided);
    Solved planted = sound;
    planted.spectrum.eigenvalues[1] = 0;
    EXPECT_EQ(planted.certificate().zero_eigenvalues, 2);
    EXPECT_FALSE(planted.certificate().zeros_undecided);
    EXPECT_EQ(planted.certificate().verdict(), Proof::refuted);
}

TEST(SpectrumCertificate, IsThatOfTheShapeWhateverItsScaleAndPlace) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const SpectrumCertificate reference = solved(mesh, 8).certificate();
    for (const double scale : {1e-75, 1e-6, 1e6, 1e80}) {
        const SpectrumCertificate c = solved(moved_by(scaled(mesh, scale), Vector3::Constant(1e3 * scale)), 8).certificate();
        EXPECT_TRUE(c.holds()) << c.residual << " " << c.parseval_gap;
        EXPECT_NEAR(c.shift * scale * scale, reference.shift, 1e-6 * reference.shift);
        EXPECT_LT(c.delta * scale * scale, 2 * reference.delta);
    }
}

TEST(SpectrumCertificate, AnotherOperatorIsNotTheOneSolved) {
    Solved s = solved(lopsided_ellipsoid(3), 8);
    s.laplacian.M *= 2;
    EXPECT_NEAR(s.certificate().orthonormality_error, 1, 1e-6);
    EXPECT_NE(s.certificate().complete, Proof::proved);
    EXPECT_GT(s.certificate().residual, 0.1);
}

TEST(SpectrumCertificate, SizesMustFit) {
    Solved s = solved(icosphere(1), 4);
    s.spectrum.eigenvalues.conservativeResize(3);
    EXPECT_THROW(s.certificate(), MeshError);
    s.spectrum.eigenvalues.resize(0);
    s.spectrum.eigenvectors.resize(s.mesh.vertex_count(), 0);
    EXPECT_THROW(s.certificate(), MeshError);
}

TEST(SpectrumCertificate, InertiaCountsTheEigenvaluesOfTheSphere) {
    const LaplaceBeltrami laplacian = laplace_beltrami(icosphere(4));
    EXPECT_EQ(eigenvalues_below(laplacian, -0.01).below, 0);
    EXPECT_EQ(eigenvalues_below(laplacian, 1).below, 1);
    EXPECT_EQ(eigenvalues_below(laplacian, 4).below, 1 + 3);
    EXPECT_EQ(eigenvalues_below(laplacian, 9).below, 1 + 3 + 5);
    EXPECT_EQ(eigenvalues_below(laplacian, 16).below, 1 + 3 + 5 + 7);
}

TEST(SpectrumCertificate, HoldsOnTheArmadillo) {
    SHARED_MESH_OR_SKIP(mesh, "coursework/decompose/armadillo.obj");
    for (const int k : {5, 15, 60, mesh.vertex_count()}) {
        const SpectrumCertificate c = solved(mesh, k).certificate();
        EXPECT_TRUE(c.holds()) << k << ": " << c.residual << " " << c.orthonormality_error << " " << c.parseval_gap;
        EXPECT_EQ(c.counted_below, k);
    }
}
