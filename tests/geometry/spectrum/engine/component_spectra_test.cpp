// The spectrum of a mesh of several components is the union of theirs.
#include "geometry/spectrum/engine/spectrum_modes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "base/errors.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "geometry/spectrum/spectrum_expectations.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

TriangleMesh in_a_row(const std::vector<TriangleMesh>& parts) {
    TriangleMesh all;
    double x = 0;
    for (const TriangleMesh& part : parts) {
        const double left = part.X.col(0).minCoeff();
        const TriangleMesh placed = moved_by(part, {x - left, 0, 0});
        x += 1.5 * (part.X.col(0).maxCoeff() - left);
        all = all.vertex_count() == 0 ? placed : side_by_side(all, placed);
    }
    return all;
}

std::vector<TriangleMesh> copies(int count, const TriangleMesh& mesh) {
    return std::vector<TriangleMesh>(static_cast<std::size_t>(count), mesh);
}

/// All eigenvalues of all parts together, each part solved densely, ascending.
Vector united_spectra(const std::vector<TriangleMesh>& parts) {
    std::vector<double> all;
    for (const TriangleMesh& part : parts) {
        const Vector mu = smallest_eigenpairs(laplace_beltrami(part), part.vertex_count(), by_dense).eigenvalues;
        all.insert(all.end(), mu.begin(), mu.end());
    }
    std::sort(all.begin(), all.end());
    return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
}

void expect_values(const Vector& mu, const Vector& expected, const std::string& what) {
    for (Eigen::Index j = 0; j < mu.size(); ++j) EXPECT_NEAR(mu[j], expected[j], 1e-10 * expected[j]) << what << ", value " << j;
}

}   // namespace

TEST(ComponentSpectra, AreUnitedIntoThatOfTheWhole) {
    const std::vector<TriangleMesh> parts = {lopsided_ellipsoid(3), scaled(cube_mesh(8), 0.3), scaled(irregular_sphere(2), 0.5),
                                             irregular_plane(20), scaled(grid_mesh(2, 2, 1, 1), 0.2)};
    const Vector expected = united_spectra(parts);
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row(parts));
    ASSERT_EQ(laplacian.M.size(), expected.size());
    for (const SpectrumOptions& options : {by_lanczos, SpectrumOptions(), by_dense}) {
        for (const int k : {1, 5, 23, 120}) {
            const Spectrum spectrum = smallest_eigenpairs(laplacian, k, options);
            const std::string what = "k = " + std::to_string(k) + ", dense below " + std::to_string(options.dense_below);
            ASSERT_EQ(spectrum.eigenvalues.size(), k);
            expect_values(spectrum.eigenvalues, expected, what);
            expect_eigenpairs(laplacian, spectrum, 1e-8, what);
        }
    }
    const Spectrum all = smallest_eigenpairs(laplacian, 100'000, by_dense);
    ASSERT_EQ(all.eigenvalues.size(), expected.size());
    expect_values(all.eigenvalues, expected, "all");
}

// N(μ) of a strip grows like its length times √μ, not like its area: it has far more of the smallest eigenvalues than its share.
TEST(ComponentSpectra, OfAThinStripAreMoreThanItsAreaLetsExpect) {
    const std::vector<TriangleMesh> parts = {lopsided_ellipsoid(3), grid_mesh(150, 3, 50, 0.1), scaled(grid_mesh(120, 2, 50, 0.1), 0.5)};
    const Vector expected = united_spectra(parts);
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row(parts));
    for (const SpectrumOptions& options : {by_lanczos, SpectrumOptions()}) {
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 80, options);
        expect_values(spectrum.eigenvalues, expected, "strips");
        expect_eigenpairs(laplacian, spectrum, 1e-8, "strips");
    }
}

TEST(ComponentSpectra, OfManyEqualComponentsAreComplete) {
    const TriangleMesh grid = grid_mesh(4, 4, 1, 1);   // 3 × 3 squares
    const Vector one = united_spectra({grid});
    for (const auto& [count, k] : {std::pair{60, 400}, std::pair{30, 400}, std::pair{200, 1000}}) {
        const TriangleMesh mesh = in_a_row(copies(count, grid));
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const Spectrum spectrum = smallest_eigenpairs(laplacian, k);
        ASSERT_EQ(spectrum.eigenvalues.size(), k);
        for (int j = 0; j < k; ++j) EXPECT_NEAR(spectrum.eigenvalues[j], one[j / count], 1e-10 * (1 + one[j / count])) << j;
        expect_eigenpairs(laplacian, spectrum, 1e-8, std::to_string(count) + " grids");
        EXPECT_EQ((spectrum.eigenvalues.array() == 0).count(), count);
        EXPECT_TRUE(certify_spectrum(mesh, laplacian, spectrum).holds());
    }
}

TEST(ComponentSpectra, OfDifferentScalesAreFoundSideBySide) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const int n = mesh.vertex_count();
    const std::vector<TriangleMesh> parts = {scaled(mesh, 1e-6), mesh, scaled(mesh, 1e-3)};
    const Vector expected = united_spectra(parts);
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row(parts));
    for (const SpectrumOptions& options : {by_lanczos, SpectrumOptions()}) {
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 70, options);
        expect_values(spectrum.eigenvalues, expected, "low");
        expect_eigenpairs(laplacian, spectrum, 1e-8, "low");
    }
    const Spectrum most = smallest_eigenpairs(laplacian, n + 60);   // by dense solvers
    expect_values(most.eigenvalues, expected, "beyond the largest component's last");
    expect_eigenpairs(laplacian, most, 1e-8, "beyond the largest component's last");
}

TEST(ComponentSpectra, OfASquareBesideASmallOneAreCertified) {
    const TriangleMesh square = grid_mesh(30, 30, 1, 1);
    for (const double scale : {1.0, 1e-4, 1e-7}) {
        const TriangleMesh mesh = in_a_row({square, scaled(square, scale)});
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        for (const int k : {20, 120}) {
            const Spectrum spectrum = smallest_eigenpairs(laplacian, k);
            const SpectrumCertificate c = certify_spectrum(mesh, laplacian, spectrum);
            // The constant of a speck with 1e-14 of the area has eigenvalue 0 ± ε A_ii/M_ii, more than the gap.
            const Proof expected = scale < 1e-6 ? Proof::undecided : Proof::proved;
            EXPECT_EQ(c.verdict(), expected) << scale << ", " << k << ": residual " << c.residual << ", limit " << c.residual_limit << ", "
                                             << c.counted_below << " counted, " << c.found_below << " found, zeros " << c.zero_eigenvalues;
        }
    }
}

TEST(ComponentSpectra, AClusterOfEqualComponentsIsNotCutByTheGap) {
    const int count = 7;
    const TriangleMesh mesh = in_a_row(copies(count, lopsided_ellipsoid(2)));
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    for (const SpectrumOptions& options : {by_lanczos, SpectrumOptions()}) {
        for (const int k : {3, 25, 28, 60}) {
            const Spectrum spectrum = smallest_eigenpairs(laplacian, k, options);
            EXPECT_EQ(eigenvalues_below(laplacian, spectrum.gap_middle).below, count * ((k + count - 1) / count)) << k;
            expect_eigenpairs(laplacian, spectrum, 1e-8, "seven ellipsoids");
            EXPECT_TRUE(certify_spectrum(mesh, laplacian, spectrum).holds()) << k;
        }
    }
}

TEST(ComponentSpectra, VectorsLiveOnOneComponentEach) {
    const std::vector<TriangleMesh> parts = {icosphere(2), icosphere(2), lopsided_ellipsoid(2)};
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row(parts));
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 40);
    const Eigen::Index n = parts[0].vertex_count();
    for (Eigen::Index j = 0; j < 40; ++j) {
        int supports = 0;
        for (int c = 0; c < 3; ++c) {
            const auto part = spectrum.eigenvectors.col(j).segment(c * n, n);
            supports += part.cwiseAbs().maxCoeff() > 0;
            if (j == c) {
                EXPECT_NEAR(part.minCoeff() / part.maxCoeff(), 1, 1e-13) << "the constants, in the order of the components";
            }
        }
        EXPECT_EQ(supports, 1) << j;
        EXPECT_GT(spectrum.eigenvectors.col(j).maxCoeff(), -(1 - 1e-6) * spectrum.eigenvectors.col(j).minCoeff());
    }
}

TEST(ComponentSpectra, OfVerticesWithoutEdgesAreZeros) {
    const LaplaceBeltrami dust{SparseMatrix(5, 5), Vector::LinSpaced(5, 1, 2)};
    for (const int k : {1, 3, 5}) {
        const Spectrum spectrum = smallest_eigenpairs(dust, k);
        EXPECT_EQ(spectrum.eigenvalues, Vector::Zero(k));
        expect_eigenpairs(dust, spectrum, 1e-15, "dust");
    }
}

TEST(ComponentSpectra, AreTheSameForAnyNumberOfThreads) {
    const LaplaceBeltrami laplacian =
        laplace_beltrami(in_a_row({lopsided_ellipsoid(3), lopsided_ellipsoid(4), grid_mesh(9, 7, 1, 1), irregular_sphere(2)}));
    const Spectrum two = smallest_eigenpairs(laplacian, 150);
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    const Spectrum one = smallest_eigenpairs(laplacian, 150, {.threads = 1});
    EXPECT_EQ(one.eigenvalues, two.eigenvalues);
    EXPECT_EQ(one.eigenvectors, two.eigenvectors);
    EXPECT_EQ(one.gap_middle, two.gap_middle);
}

TEST(ComponentSpectra, ProgressRisesToOneAndMayStop) {
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row({lopsided_ellipsoid(4), icosphere(1), lopsided_ellipsoid(4)}));
    struct Stopped {};
    std::vector<double> seen;
    SpectrumOptions options;
    options.progress = [&](double fraction) { seen.push_back(fraction); };
    smallest_eigenpairs(laplacian, 30, options);
    ASSERT_GT(seen.size(), 10u);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1);
    options.progress = [&](double fraction) {
        if (fraction > 0.5) throw Stopped();
    };
    EXPECT_THROW(smallest_eigenpairs(laplacian, 30, options), Stopped);
}

// A strip has more of the small eigenvalues than was asked of it at first: it is solved in two rounds.
TEST(ComponentSpectra, ProgressRisesOverSeveralRounds) {
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row({lopsided_ellipsoid(3), grid_mesh(150, 3, 50, 0.1)}));
    std::vector<double> seen;
    SpectrumOptions options = by_lanczos;
    options.progress = [&](double fraction) { seen.push_back(fraction); };
    smallest_eigenpairs(laplacian, 80, options);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1);
}

TEST(ComponentSpectra, MemoryIsRefusedBeforeStarting) {
    const LaplaceBeltrami laplacian = laplace_beltrami(in_a_row(copies(4, icosphere(4))));
    bool begun = false;
    SpectrumOptions options;
    options.progress = [&](double) { begun = true; };
    options.memory_limit = 1e6;
    EXPECT_THROW(smallest_eigenpairs(laplacian, 100, options), SolverError);
    EXPECT_FALSE(begun);
}
