#include "questions/bench/curvature_bench.h"
#include "questions/bench/estimators.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <set>

using namespace meshfolio;

TEST(CurvatureBench, OrderIsTheExponentOfTheFinestThree) {
    const auto order = [](std::vector<double> mean_edges, std::vector<double> errors) {
        return ErrorHistory{std::move(mean_edges), std::move(errors)}.order();
    };
    EXPECT_NEAR(order({1, 0.5, 0.25}, {3, 0.75, 0.1875}).exponent, 2, 1e-12);
    EXPECT_NEAR(order({1, 0.5, 0.25}, {3, 0.75, 0.1875}).margin, 0, 1e-11);
    EXPECT_NEAR(order({2, 1, 0.5, 0.25}, {1e9, 3, 1.5, 0.75}).exponent, 1, 1e-12) << "the coarsest is left out";
    EXPECT_NEAR(order({1, 0.5}, {1, 1}).exponent, 0, 1e-12);
    EXPECT_TRUE(std::isnan(order({1}, {1}).exponent));
    EXPECT_TRUE(std::isnan(order({1, 0.5}, {0, 0}).exponent));
    EXPECT_TRUE(std::isnan(order({1, 0.5, 0.25}, {1e-15, 1e-14, 1e-13}).exponent)) << "rounding has no order";
}

// log₂ errors 0, 1, 0 over log₂ h 0, 1, 2: slope 0, residual sum of squares ⅔, Σ(x − x̄)² = 2, one degree of freedom; t = tan(0.475 π).
TEST(CurvatureBench, MarginIsHalfStudentsConfidenceInterval) {
    const Order scattered = ErrorHistory{{1, 2, 4}, {1, 2, 1}}.order();
    EXPECT_NEAR(scattered.exponent, 0, 1e-12);
    EXPECT_NEAR(scattered.margin, std::tan(0.475 * M_PI) * std::sqrt(1.0 / 3), 1e-4);
    EXPECT_TRUE(std::isnan((ErrorHistory{{1, 0.5}, {1, 0.5}}.order().margin)));
}

TEST(CurvatureBench, FormatsOrders) {
    EXPECT_EQ(words_of({-0.5, 0.25}), "−0.50\u202f±\u202f0.25");
    EXPECT_EQ(words_of({1.98, 0.0002}), "1.98\u202f±\u202f<\u202f0.001");
    EXPECT_EQ(words_of({1.98, 0.004}), "1.98\u202f±\u202f0.004");
    EXPECT_EQ(words_of({std::nan(""), std::nan(""), true}), "exact");
    EXPECT_EQ(words_of({std::nan(""), std::nan("")}), "–") << "not known, which is not exact";
}

TEST(CurvatureBench, TrendWordsFollowTheNumbers) {
    EXPECT_EQ(trend({{1, 0.5, 0.25}, {0.16, 0.04, 0.01}}).substr(0, 5), "falls");
    EXPECT_EQ(trend({{1, 0.5, 0.25}, {0.01, 0.02, 0.04}}).substr(0, 5), "grows");
    EXPECT_NE(trend({{1, 0.5, 0.25}, {0.1, 0.1, 0.1}}).find("without converging"), std::string::npos);
    EXPECT_NE(trend({{1, 0.5, 0.25}, {1e-15, 2e-15, 1e-14}}).find("rounding"), std::string::npos);
    EXPECT_TRUE((ErrorHistory{{1, 0.5}, {0.2, 0.1}}.order().converges()));
    EXPECT_FALSE((ErrorHistory{{1, 0.5}, {0.1, 0.1}}.order().converges()));
    EXPECT_FALSE((ErrorHistory{{1, 0.5}, {std::nan(""), 0.02}}.order().converges())) << "one error shows no order";
    EXPECT_TRUE((ErrorHistory{{1, 0.5}, {1e-15, 1e-15}}.order().converges())) << "rounding";
}

TEST(CurvatureBench, NormalPartOfTheUniformLaplacianIsExactOnASphere) {
    const KnownSurface sphere = known_surface("sphere");
    const BenchLevel regular = measured(bench_mesh(sphere, MeshKind::regular, 3, 1));
    const BenchLevel moved = measured(bench_mesh(sphere, MeshKind::jittered, 3, 1));
    EXPECT_LT(regular.error("H.uniform_n").linf, 1e-11);
    EXPECT_LT(moved.error("H.uniform_n").linf, 1e-11);
    EXPECT_GT(moved.error("H.uniform").l2, 0.5);   // while the norm of all of Δx is useless
    // With the normals of the mesh itself it is not exact.
    EXPECT_GT(regular.error("H.uniform_own_n").l2, 1e-3);
    EXPECT_LT(regular.error("H.uniform_own_n").l2, 0.02);
    EXPECT_GT(moved.error("H.uniform_own_n").l2, 0.02);
}

TEST(CurvatureBench, EstimatorsHaveTheSignAndMagnitudeOfTheTruth) {
    const BenchMesh sphere = bench_mesh(known_surface("sphere"), MeshKind::regular, 3, 1);
    for (const Estimator& e : estimators()) {
        const Vector& truth = e.quantity == Quantity::H ? sphere.H : sphere.K;
        EXPECT_NEAR(summary_of(e.estimate(sphere).cwiseQuotient(truth)).median, 1, 0.3)
            << e.key
            << ", over the truth on a sphere: H is (κ₁ + κ₂)/2, positive with the normals outward; the uniform one is a fifth too large";
    }
}

TEST(CurvatureBench, JitterStopsTheCotangentOperatorFromConverging) {
    const BenchRuns runs = bench_runs(MeshLibrary({}, {}), {known_surface("torus")}, question_kinds, {3, 4, 5}, 1, [](std::string_view) {});
    for (const MeshKind kind : question_kinds)
        EXPECT_EQ(run_on(runs, "torus", kind).errors("H.mixed").order().converges(), kind == MeshKind::regular);
}

TEST(CurvatureBench, MeasuresEachMeshOnce) {
    std::atomic<int> meshes = 0;
    KnownSurface saddle = known_surface("saddle");
    saddle.projected = [&, projected = saddle.projected](const Vector3& p) { return ++meshes, projected(p); };   // jitters random points
    const MeshLibrary library({}, {});
    const auto errors = [&] {
        return bench_runs(library, {saddle}, panel_kinds, {2, 3}, 7, [](std::string_view) {}).back().errors("H.jet").errors;
    };
    const std::vector<double> first = errors();
    const int made = meshes;
    EXPECT_GT(made, 0);
    EXPECT_EQ(errors(), first);
    EXPECT_EQ(meshes, made);
}

TEST(CurvatureBench, ResultsDependOnTheSeedAlone) {
    const auto errors = [](std::uint64_t seed) {
        return measured(bench_mesh(known_surface("ellipsoid"), MeshKind::random, 3, seed)).error("H.jet").l2;
    };
    EXPECT_EQ(errors(1), errors(1));
    EXPECT_NE(errors(1), errors(2));
}

TEST(CurvatureBench, EstimatorsHaveUniqueKeysAndNames) {
    std::set<std::pair<Quantity, std::string>> names;
    for (const Estimator& e : estimators()) {
        EXPECT_EQ(&estimator(e.key), &e) << e.key;
        EXPECT_EQ(e.key.substr(0, 2), symbol(e.quantity) + ".");
        EXPECT_TRUE(names.insert({e.quantity, e.name()}).second) << e.name();
    }
    EXPECT_THROW(estimator("H.nothing"), std::logic_error);
}
