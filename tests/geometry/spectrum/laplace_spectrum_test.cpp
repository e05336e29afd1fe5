#include "geometry/spectrum/laplace_spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/spectrum_expectations.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Largest relative error of the eigenvalues of degree l on the unit sphere, l(l+1) with multiplicity 2l + 1.
double sphere_error(const Spectrum& spectrum, int l) {
    return (spectrum.eigenvalues.segment(l * l, 2 * l + 1).array() / (l * (l + 1)) - 1).abs().maxCoeff();
}

/// Returns the sine of the largest angle between the spans of Phi and Psi, both M-orthonormal.
double distance_of_spans(const DenseMatrix& Phi, const DenseMatrix& Psi, const Vector& M) {
    const DenseMatrix outside = Phi - Psi * (Psi.transpose() * (M.asDiagonal() * Phi));
    return std::sqrt((M.asDiagonal() * outside.cwiseAbs2()).colwise().sum().maxCoeff());
}

/// Entries that are stored and 0 between the first vertex of the operator and all others.
LaplaceBeltrami with_edges_of_no_weight(LaplaceBeltrami laplacian) {
    for (int i = 2; i < laplacian.M.size(); i += 7) {
        laplacian.C.coeffRef(i, 1) += 0;
        laplacian.C.coeffRef(1, i) += 0;
    }
    laplacian.C.makeCompressed();
    return laplacian;
}

/// Vertex 0 joined to each of the others by a spring of the given weight, all masses equal, 1 in all.
LaplaceBeltrami star_operator(const Vector& weights) {
    const Eigen::Index n = weights.size() + 1;
    LaplaceBeltrami star{SparseMatrix(n, n), Vector::Constant(n, 1.0 / static_cast<double>(n))};
    for (Eigen::Index j = 1; j < n; ++j) {
        star.C.coeffRef(0, j) = star.C.coeffRef(j, 0) = weights[j - 1];
        star.C.coeffRef(0, 0) -= weights[j - 1];
        star.C.coeffRef(j, j) = -weights[j - 1];
    }
    return star;
}

void expect_eigenpairs(const LaplaceBeltrami& laplacian, const Spectrum& s, const std::string& what) {
    const double area = laplacian.M.sum();
    for (Eigen::Index j = 0; j < s.eigenvalues.size(); ++j) {
        const Vector phi = s.eigenvectors.col(j), Mphi = laplacian.M.cwiseProduct(phi);
        const double residual = (-(laplacian.C * phi) - s.eigenvalues[j] * Mphi).norm();
        const double size = s.eigenvalues[j] > 0 ? s.eigenvalues[j] * Mphi.norm() : 1 / std::sqrt(area);
        EXPECT_LT(residual / size, 1e-8) << what << ", pair " << j;
        EXPECT_NEAR(residual / size, s.residuals[j], 1e-11) << what << ", pair " << j;
    }
    EXPECT_LT(orthonormality_error(s, laplacian.M), 1e-11) << what;
    EXPECT_TRUE(std::is_sorted(s.eigenvalues.begin(), s.eigenvalues.end())) << what;
    EXPECT_NE(counted_below_last(laplacian, s), Proof::refuted) << what;
}

}   // namespace

TEST(LaplaceSpectrum, OfTheSphereIsThatOfSphericalHarmonicsToSecondOrder) {
    constexpr int k = 49;   // l = 0 … 6
    const Spectrum coarse = smallest_eigenpairs(laplace_beltrami(icosphere(3)), k, by_lanczos);
    const Spectrum fine = smallest_eigenpairs(laplace_beltrami(icosphere(4)), k, by_lanczos);
    EXPECT_EQ(fine.eigenvalues[0], 0);
    for (int l = 2; l <= 6; ++l) {   // l = 1 converges faster still
        EXPECT_NEAR(std::log2(sphere_error(coarse, l) / sphere_error(fine, l)), 2, 0.1) << "degree " << l;
        EXPECT_LT(sphere_error(fine, l), 5e-4 * l * (l + 1)) << "degree " << l;
    }
    EXPECT_LT(sphere_error(fine, 1), 1e-5);
}

TEST(LaplaceSpectrum, OfTheFlatTorusIsExactWithAllMultiplicities) {
    constexpr int n = 30, k = 90;
    const Vector exact = five_point_spectrum(n);
    for (const SpectrumOptions& options : {by_lanczos, by_dense}) {
        const LaplaceBeltrami laplacian = flat_torus_operator(n, n, std::sqrt(2.0));
        const Spectrum spectrum = smallest_eigenpairs(laplacian, k, options);
        EXPECT_LT((spectrum.eigenvalues - exact.head(k)).cwiseAbs().maxCoeff(), 1e-11) << "dense " << spectrum.dense;
        expect_eigenpairs(laplacian, spectrum, "flat torus");
    }
}

// A Krylov space holds one direction of an eigenspace for each vector it began with: the next block is rounding only, and what is
// still asked for must come from elsewhere.
TEST(LaplaceSpectrum, EigenspacesLargerThanABlockAreFoundWhole) {
    Vector weights(260);
    weights << Vector::Constant(60, 1), Vector::Constant(100, 10), Vector::Constant(100, 20);
    const LaplaceBeltrami star = star_operator(weights / 261);
    constexpr int k = 60;   // 0, then 1 as often as two leaves of that weight differ
    const Spectrum spectrum = smallest_eigenpairs(star, k, by_lanczos);
    EXPECT_FALSE(spectrum.dense);
    EXPECT_LT((spectrum.eigenvalues.tail(k - 1).array() - 1).abs().maxCoeff(), 1e-11) << "ε times the row of the hub";
    expect_eigenpairs(star, spectrum, "star");
}

// 4π²(m² + n²)/area, and the error falls by four when the squares are halved.
TEST(LaplaceSpectrum, OfTheFlatTorusConvergesToThatOfTheSmoothOne) {
    const auto error = [](int n) {
        const Spectrum s = smallest_eigenpairs(flat_torus_operator(n, n, std::sqrt(2.0)), 9);
        const double unit = 4 * pi * pi / (n * n);
        return std::max(std::abs(s.eigenvalues[1] / unit - 1), std::abs(s.eigenvalues[8] / unit - 2));
    };
    EXPECT_NEAR(std::log2(error(12) / error(24)), 2, 0.05);
}

TEST(LaplaceSpectrum, DenseAndLanczosAgree) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(3));
    constexpr int k = 60;
    const Spectrum dense = smallest_eigenpairs(laplacian, k, by_dense), lanczos = smallest_eigenpairs(laplacian, k, by_lanczos);
    EXPECT_TRUE(dense.dense);
    EXPECT_FALSE(lanczos.dense);
    EXPECT_LT((lanczos.eigenvalues - dense.eigenvalues).tail(k - 1).cwiseQuotient(dense.eigenvalues.tail(k - 1)).cwiseAbs().maxCoeff(),
              1e-10);
    EXPECT_LT(distance_of_spans(lanczos.eigenvectors, dense.eigenvectors, laplacian.M), 1e-6);
    EXPECT_LT((lanczos.eigenvectors - dense.eigenvectors).leftCols(12).cwiseAbs().maxCoeff(), 1e-6) << "no multiplicities: signs too";
}

TEST(LaplaceSpectrum, PairsSolveTheEquationOnEveryKindOfMesh) {
    const std::vector<std::pair<std::string, TriangleMesh>> meshes = {
        {"open grid", grid_mesh(24, 17, 3, 2)},
        {"irregular plane", irregular_plane(25)},
        {"cube", cube_mesh(11)},
        {"torus", torus_mesh(40, 20, 1, 0.4)},
        {"two components", side_by_side(lopsided_ellipsoid(3), moved_by(scaled(icosphere(2), 0.1), {5, 0, 0}))},
        {"unreferenced vertex", with_unreferenced_vertex(irregular_sphere(3), {9, 9, 9})}};
    for (const auto& [name, mesh] : meshes) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh, AreaForm::mixed);
        for (const int k : {1, 2, 7, 40}) {
            expect_eigenpairs(laplacian, smallest_eigenpairs(laplacian, k, by_lanczos), name + " by Lanczos");
            if (k == 40) expect_eigenpairs(laplacian, smallest_eigenpairs(laplacian, k, by_dense), name + " dense");
        }
    }
}

TEST(LaplaceSpectrum, AllPairsDiagonaliseTheOperator) {
    const LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(2));
    const int n = static_cast<int>(laplacian.M.size());
    const Spectrum spectrum = smallest_eigenpairs(laplacian, n + 5);
    ASSERT_EQ(spectrum.eigenvalues.size(), n) << "k is cut to the number of vertices";
    const double trace = (-laplacian.C.diagonal()).cwiseQuotient(laplacian.M).sum();
    EXPECT_NEAR(spectrum.eigenvalues.sum() / trace, 1, 1e-12);
    const DenseMatrix H = spectrum.eigenvectors.transpose() * (-laplacian.C * spectrum.eigenvectors);
    EXPECT_LT((H - DenseMatrix(spectrum.eigenvalues.asDiagonal())).cwiseAbs().maxCoeff(), 1e-11 * spectrum.eigenvalues[n - 1]);
}

TEST(LaplaceSpectrum, OneZeroModeAComponentConstantOnIt) {
    const TriangleMesh three = side_by_side(side_by_side(icosphere(2), moved_by(irregular_sphere(2, 3), {9, 0, 0})), grid_mesh(9, 9, 1, 1));
    const LaplaceBeltrami laplacian = laplace_beltrami(with_unreferenced_vertex(three, {0, 0, 0}));
    for (const SpectrumOptions& options : {by_lanczos, by_dense}) {
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 8, options);
        EXPECT_EQ((spectrum.eigenvalues.array() == 0).count(), 3);
        EXPECT_GT(spectrum.eigenvalues[3], 0);
        const auto first = spectrum.eigenvectors.col(0);
        EXPECT_EQ(first[0], 0) << "the unreferenced vertex";
        EXPECT_LT((first.segment(1, 162).array() * std::sqrt(laplacian.M.segment(1, 162).sum()) - 1).abs().maxCoeff(), 1e-14);
        EXPECT_EQ(first.tail(first.size() - 163).cwiseAbs().maxCoeff(), 0);
    }
    const Spectrum clamped = smallest_eigenpairs(with_edges_of_no_weight(laplacian), 4, by_lanczos);
    EXPECT_EQ((clamped.eigenvalues.array() == 0).count(), 3) << "entries that are 0 join nothing";
    for (const int k : {1, 2, 3}) {
        const Spectrum few = smallest_eigenpairs(laplacian, k, by_lanczos);
        EXPECT_EQ(few.eigenvalues.size(), k);
        EXPECT_EQ(eigenvalues_below(laplacian, few.gap_middle).below, 3) << "zero modes are not cut apart";
    }
}

// A needle raises μ_max by orders of magnitude, specks of area lower the smallest pivots; the low modes do not care.
TEST(LaplaceSpectrum, NeedlesAndSpecksDoNotDisturb) {
    const TriangleMesh grid = grid_mesh(20, 20, 1, 1);
    TriangleMesh needles = grid;
    needles.X.row(200) += (1 - 1e-7) * (grid.X.row(201) - grid.X.row(200));
    const LaplaceBeltrami laplacian = laplace_beltrami(side_by_side(needles, moved_by(scaled(icosphere(1), 1e-7), {2, 2, 0})));
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 12, by_lanczos);
    EXPECT_EQ((spectrum.eigenvalues.array() == 0).count(), 2);
    EXPECT_NE(counted_below_last(laplacian, spectrum), Proof::refuted);
    EXPECT_NEAR(spectrum.eigenvalues[2] / (pi * pi), 1, 0.02);
    EXPECT_NEAR(spectrum.eigenvalues[4] / (2 * pi * pi), 1, 0.02);
    EXPECT_LT(orthonormality_error(spectrum, laplacian.M), 1e-10);
    EXPECT_LT(spectrum.residuals.maxCoeff(), 1e-5) << "ε‖B‖/μ";
}

TEST(LaplaceSpectrum, ScalesLikeOneOverArea) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const Spectrum reference = smallest_eigenpairs(laplace_beltrami(mesh), 20, by_lanczos);
    for (const double s : {1e-9, 1e9}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(scaled(mesh, s));
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 20, by_lanczos);
        EXPECT_LT(largest_relative_difference(spectrum.eigenvalues * s * s, reference.eigenvalues), 1e-11);
        EXPECT_LT((spectrum.eigenvectors * s - reference.eigenvectors).cwiseAbs().maxCoeff(), 1e-6);
        expect_eigenpairs(laplacian, spectrum, "scaled");
    }
}

TEST(LaplaceSpectrum, MotionAndVertexOrderChangeNothing) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const Vector mu = smallest_eigenpairs(laplace_beltrami(mesh), 20, by_lanczos).eigenvalues;
    const Vector moved = smallest_eigenpairs(laplace_beltrami(rotated_and_moved(mesh)), 20, by_lanczos).eigenvalues;
    const Vector shuffled = smallest_eigenpairs(laplace_beltrami(with_shuffled_vertices(mesh).mesh), 20, by_lanczos).eigenvalues;
    const Vector far = smallest_eigenpairs(laplace_beltrami(moved_by(mesh, {1e7, -1e7, 1e7})), 20, by_lanczos).eigenvalues;
    for (int j = 1; j < mu.size(); ++j) {
        EXPECT_NEAR(moved[j] / mu[j], 1, 1e-11);
        EXPECT_NEAR(shuffled[j] / mu[j], 1, 1e-11);
        EXPECT_NEAR(far[j] / mu[j], 1, 1e-6) << "the coordinates themselves are rounded at 1e-9";
    }
}

TEST(LaplaceSpectrum, IsTheSameEveryTime) {
    const LaplaceBeltrami laplacian = laplace_beltrami(cube_mesh(12));
    const Spectrum once = smallest_eigenpairs(laplacian, 15, by_lanczos), again = smallest_eigenpairs(laplacian, 15, by_lanczos);
    EXPECT_EQ(once.eigenvalues, again.eigenvalues);
    EXPECT_EQ(once.eigenvectors, again.eigenvectors);
}

TEST(LaplaceSpectrum, LargestEntryIsPositive) {
    for (const SpectrumOptions& options : {by_lanczos, by_dense}) {
        const Spectrum spectrum = smallest_eigenpairs(laplace_beltrami(lopsided_ellipsoid(3)), 30, options);
        EXPECT_TRUE(((spectrum.eigenvectors.colwise().maxCoeff() + spectrum.eigenvectors.colwise().minCoeff()).array() > 0).all());
    }
}

TEST(LaplaceSpectrum, ProgressRisesToOne) {
    SpectrumOptions options = by_lanczos;
    std::vector<double> seen;
    options.progress = [&](double fraction) { seen.push_back(fraction); };
    smallest_eigenpairs(laplace_beltrami(torus_mesh(40, 20, 1, 0.4)), 12, options);
    ASSERT_GT(seen.size(), 10u);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_GE(seen.front(), 0);
    EXPECT_EQ(seen.back(), 1);
}

TEST(LaplaceSpectrum, RefusesOperatorsWithoutSpectrum) {
    const LaplaceBeltrami laplacian = laplace_beltrami(icosphere(1));
    EXPECT_THROW(smallest_eigenpairs(laplacian, 0), MeshError);
    EXPECT_THROW(smallest_eigenpairs({laplacian.C, Vector::Ones(3)}, 2), MeshError);
    EXPECT_THROW(smallest_eigenpairs({laplacian.C, Vector::Zero(laplacian.M.size())}, 2), MeshError);
    Vector M = laplacian.M;
    M[5] = -M[5];
    EXPECT_THROW(smallest_eigenpairs({laplacian.C, M}, 2), MeshError);
    for (const SpectrumOptions& options : {by_lanczos, by_dense}) {
        EXPECT_THROW(smallest_eigenpairs({-laplacian.C, laplacian.M}, 2, options), SolverError) << "the wrong sign";
    }
}
