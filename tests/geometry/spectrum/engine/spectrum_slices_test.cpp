#include "geometry/spectrum/engine/spectrum_slices.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "base/errors.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/engine/slice_limits.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectrum_expectations.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Slices of few pairs whatever the size of the mesh.
SpectrumOptions in_slices(int pairs) {
    SpectrumOptions options;
    options.dense_below = 0;
    options.one_slice_up_to = 0;
    options.pairs_per_slice = pairs;
    return options;
}

double eigenvalue_difference(const Vector& mu, const Vector& nu) {
    return (mu - nu).cwiseQuotient(nu.cwiseMax(nu[nu.size() - 1] * 1e-3)).cwiseAbs().maxCoeff();
}

struct Stopped {};

}   // namespace

TEST(SpectrumSlices, AgreeWithTheDenseSolver) {
    const LaplaceBeltrami laplacian = laplace_beltrami(torus_mesh(40, 24, 1, 0.4));
    constexpr int k = 230;
    const Spectrum dense = smallest_eigenpairs(laplacian, k, by_dense), sliced = smallest_eigenpairs(laplacian, k, in_slices(40));
    EXPECT_TRUE(dense.dense);
    EXPECT_FALSE(sliced.dense);
    EXPECT_GE(sliced.slices, 6);
    EXPECT_LT(eigenvalue_difference(sliced.eigenvalues, dense.eigenvalues), 1e-11);
    expect_eigenpairs(laplacian, sliced, 1e-8, "torus");
}

// Too many pairs for half of the space: the basis takes all of a small one.
TEST(SpectrumSlices, OfSmallMeshesAgreeWithTheDenseSolver) {
    for (const int around : {8, 9, 11, 13, 16, 20, 26}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(torus_mesh(around, 13, 1, 0.4));
        for (const int k : {8, 20, around * 13 / 4}) {
            SpectrumOptions options;
            options.dense_below = 0;
            options.polish = true;
            const Spectrum dense = smallest_eigenpairs(laplacian, k, by_dense), sliced = smallest_eigenpairs(laplacian, k, options);
            const std::string what = std::to_string(around * 13) + " vertices, k = " + std::to_string(k);
            EXPECT_FALSE(sliced.dense);
            EXPECT_LT(eigenvalue_difference(sliced.eigenvalues, dense.eigenvalues), 1e-10) << what;
            expect_eigenpairs(laplacian, sliced, 1e-8, what);
        }
    }
}

// Multiplicities 4 and 8 throughout, so that most limits would cut one.
TEST(SpectrumSlices, OfTheFlatTorusAreCompleteWhereverTheyAreCut) {
    constexpr int n = 40, k = 400;
    const LaplaceBeltrami laplacian = flat_torus_operator(n, n, std::sqrt(2.0));
    const Vector exact = five_point_spectrum(n);
    for (const int pairs : {17, 32, 60}) {
        const Spectrum spectrum = smallest_eigenpairs(laplacian, k, in_slices(pairs));
        EXPECT_LT((spectrum.eigenvalues - exact.head(k)).cwiseAbs().maxCoeff(), 1e-11) << pairs;
        expect_eigenpairs(laplacian, spectrum, 1e-8, "flat torus, " + std::to_string(pairs));
    }
}

TEST(SpectrumSlices, OfTheSphereHaveTwoLPlusOneOfEachDegree) {
    constexpr int degrees = 16;
    const Spectrum spectrum = smallest_eigenpairs(laplace_beltrami(icosphere(4)), degrees * degrees);
    EXPECT_GT(spectrum.slices, 1);
    for (int l = 1; l + 1 < degrees; ++l) {
        const auto degree = spectrum.eigenvalues.segment(l * l, 2 * l + 1);
        EXPECT_NEAR(degree.mean() / (l * (l + 1)), 1, 8e-4 * l * (l + 1)) << l;
        EXPECT_LT(degree.maxCoeff() - degree.minCoeff(), 0.2 * (spectrum.eigenvalues[(l + 1) * (l + 1)] - degree.minCoeff())) << l;
    }
}

TEST(SpectrumSlices, OfSymmetricOpenAndBrokenMeshesAreEigenpairs) {
    const std::vector<std::pair<std::string, TriangleMesh>> meshes = {
        {"cube", cube_mesh(16)},
        {"open grid", grid_mesh(40, 30, 3, 2)},
        {"irregular plane", irregular_plane(35)},
        {"components", side_by_side(torus_mesh(30, 20, 1, 0.4), moved_by(scaled(icosphere(3), 0.1), {5, 0, 0}))}};
    for (const auto& [name, mesh] : meshes) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh, AreaForm::mixed);
        for (const int pairs : {12, 40}) expect_eigenpairs(laplacian, smallest_eigenpairs(laplacian, 100, in_slices(pairs)), 1e-8, name);
    }
}

// Multiplicity 4 and 8 and more: a start vector sees one member of each. Inertia counts the others, and they are found beside the first.
TEST(SpectrumSlices, PairsMissedByOneRunAreCountedAndFound) {
    constexpr int n = 26, k = 120;
    const LaplaceBeltrami laplacian = flat_torus_operator(n, n, std::sqrt(2.0));
    const double area = laplacian.M.sum();
    const SpectrumProblem problem(-laplacian.C, laplacian.M / area);
    const Vector exact = five_point_spectrum(n) * area;
    int repairs = 0;
    for (const SpectrumOptions& options : {in_slices(30), SpectrumOptions{.one_slice_up_to = 1000}}) {
        const Modes found = find_by_slices(problem, k - 1, options);
        repairs += found.repairs;
        ASSERT_EQ(found.pairs.count(), k - 1);
        for (int j = 1; j < k; ++j) EXPECT_NEAR(found.pairs.mu[j - 1] / exact[j], 1, 1e-10) << j;
        const DenseMatrix gram = found.pairs.Y.transpose() * found.pairs.Y;
        EXPECT_LT((gram - DenseMatrix::Identity(k - 1, k - 1)).cwiseAbs().maxCoeff(), 1e-11);
    }
    EXPECT_GT(repairs, 0) << "rounding alone has shown all of them: choose a harder case";
}

TEST(SpectrumSlices, AreTheSameForAnyNumberOfThreads) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(4));
    for (const auto& [k, pairs] : {std::pair{150, 40}, std::pair{25, 0}}) {
        SpectrumOptions options = in_slices(std::max(1, pairs));
        if (pairs == 0) options.one_slice_up_to = 60;
        const Spectrum two = smallest_eigenpairs(laplacian, k, options);
        const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        options.threads = 1;
        const Spectrum one = smallest_eigenpairs(laplacian, k, options);
        EXPECT_EQ(one.eigenvalues, two.eigenvalues);
        EXPECT_EQ(one.eigenvectors, two.eigenvectors);
    }
}

TEST(SpectrumSlices, MotionAndVertexOrderChangeNothing) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    constexpr int k = 110;
    const Vector mu = smallest_eigenpairs(laplace_beltrami(mesh), k, in_slices(30)).eigenvalues;
    const Vector moved = smallest_eigenpairs(laplace_beltrami(rotated_and_moved(mesh)), k, in_slices(30)).eigenvalues;
    const Vector shuffled = smallest_eigenpairs(laplace_beltrami(with_shuffled_vertices(mesh).mesh), k, in_slices(30)).eigenvalues;
    EXPECT_LT(eigenvalue_difference(moved, mu), 1e-10);
    EXPECT_LT(eigenvalue_difference(shuffled, mu), 1e-10);
    for (const double s : {1e-9, 1e9}) {
        const Spectrum scaled_one = smallest_eigenpairs(laplace_beltrami(scaled(mesh, s)), k, in_slices(30));
        EXPECT_LT(eigenvalue_difference(scaled_one.eigenvalues * s * s, mu), 1e-10) << s;
    }
}

// Needles raise ‖B‖, and with it what the rounding of a basis means for a residual: some 1e-13 ‖B‖, which no Ritz value shows.
TEST(SpectrumSlices, BesideNeedlesAreAsGoodAsRoundingOfTheOperatorLetsThem) {
    constexpr int n = 40;
    for (const double width : {1e-4, 1e-5, 1e-6}) {
        TriangleMesh mesh = irregular_plane(n, 0.4);
        for (int i = 3; i < n - 1; i += 6) {
            for (int j = 2 + i % 4; j < n - 2; j += 6) {
                const int v = j * n + i;
                mesh.X.row(v) += (1 - width) * (mesh.X.row(v + 1) - mesh.X.row(v)).eval();
            }
        }
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 150, in_slices(40));
        const double largest_row = (-laplacian.C.diagonal()).cwiseQuotient(laplacian.M).maxCoeff();
        for (Eigen::Index j = 1; j < 150; ++j) {
            const double rounding = 50 * 2.2e-16 * largest_row / spectrum.eigenvalues[j];
            EXPECT_LT(spectrum.residuals[j], std::clamp(rounding, 5e-9, 5e-4)) << width << ", pair " << j;
        }
        EXPECT_LT(orthonormality_error(spectrum, laplacian.M), 1e-10);
        EXPECT_NE(counted_below_last(laplacian, spectrum), Proof::refuted);
    }
}

TEST(SpectrumSlices, PolishedPairsHaveResidualsOfRounding) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(4));
    for (SpectrumOptions options : {in_slices(40), SpectrumOptions{.dense_below = 0}}) {
        options.polish = true;
        const Spectrum spectrum = smallest_eigenpairs(laplacian, options.one_slice_up_to == 0 ? 130 : 30, options);
        expect_eigenpairs(laplacian, spectrum, 4e-11, "polished");
        EXPECT_LT(orthonormality_error(spectrum, laplacian.M), 1e-11);
    }
}

TEST(SpectrumSlices, StopWhenTheCallbackThrows) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(4));
    for (SpectrumOptions options : {in_slices(20), SpectrumOptions{.dense_below = 0}}) {
        for (const int last : {1, 2, 5, 7}) {
            int calls = 0;
            options.progress = [&](double) {
                if (++calls == last) throw Stopped();
            };
            EXPECT_THROW(smallest_eigenpairs(laplacian, 60, options), Stopped) << "the caller's own exception, not that of another slice";
            EXPECT_LT(calls, 40) << "the other slices stop too";
        }
    }
}

TEST(SpectrumSlices, ProgressRises) {
    SpectrumOptions options = in_slices(20);
    std::vector<double> seen;
    options.progress = [&](double fraction) { seen.push_back(fraction); };
    smallest_eigenpairs(laplace_beltrami(lopsided_ellipsoid(3)), 100, options);
    ASSERT_GT(seen.size(), 10u);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1);
}

TEST(SpectrumSlices, MemoryIsRefusedBeforeStartingWithWhatWouldFit) {
    const LaplaceBeltrami laplacian = laplace_beltrami(icosphere(4));
    SpectrumOptions options{.dense_below = 0};
    bool begun = false;
    options.progress = [&](double) { begun = true; };
    options.memory_limit = 9e6;
    try {
        smallest_eigenpairs(laplacian, 500, options);
        FAIL() << "500 pairs of 2562 vertices do not fit into 9 MB";
    } catch (const SolverError& error) {
        EXPECT_NE(std::string(error.what()).find("500 eigenpairs of 2562 vertices need"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(begun);
    EXPECT_NO_THROW(smallest_eigenpairs(laplacian, 5, options));
    options.memory_limit = 1e5;
    EXPECT_THROW(smallest_eigenpairs(laplacian, 1, options), SolverError);
}

TEST(SpectrumSlices, TheNumberSaidToFitIsTheLargestThatFits) {
    const LaplaceBeltrami laplacian = laplace_beltrami(icosphere(4));
    const SpectrumProblem problem(-laplacian.C, laplacian.M);
    for (const int k : {2, 60, 61, 75, 500}) {   // up to 60 in one slice
        for (const double share : {0.6, 0.8, 0.9, 0.999}) {
            const SpectrumOptions options{.memory_limit = share * memory_of_one_slice(problem, k, {})};
            int fitting = 0;
            try {
                slices_that_fit(problem, k, options);
                FAIL() << k << " pairs do not fit into less than they need";
            } catch (const SolverError& error) {
                const std::string message = error.what();
                if (message.find("not even one") == std::string::npos) fitting = std::stoi(message.substr(message.find("; ") + 2));
            }
            EXPECT_LT(fitting, k);
            if (fitting > 0) {
                EXPECT_EQ(slices_that_fit(problem, fitting, options), 1) << k << " at " << share;
            }
            EXPECT_THROW(slices_that_fit(problem, fitting + 1, options), SolverError) << k << " at " << share;
        }
    }
}

TEST(SpectrumSlices, LimitsHoldTheCountsOfInertia) {
    const LaplaceBeltrami laplacian = flat_torus_operator(30, 30, std::sqrt(2.0));
    const SpectrumProblem problem(-laplacian.C, laplacian.M / laplacian.M.sum());
    const Vector exact = five_point_spectrum(30) * laplacian.M.sum();
    for (const int wanted : {2, 70, 300, 880, 899}) {
        const std::vector<Count> limits = slice_limits(problem, wanted, 40);
        EXPECT_GE(limits.back().others, wanted);
        EXPECT_LE(limits.back().others, wanted + std::max(14, wanted / 10)) << wanted;
        for (const Count& count : limits) {
            if (count.sigma <= 0) continue;
            EXPECT_EQ(count.others, (exact.array() < count.sigma).count() - 1) << count.sigma;
        }
        for (std::size_t i = 1; i < limits.size(); ++i) EXPECT_LE(limits[i].others - limits[i - 1].others, 80);
    }
}
