#include "questions/q3_cotangent/parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q3_cotangent {
using namespace testing_tools;

namespace {

/// @param name  of a file, different in each test
Disagreement disagreement_on(const TriangleMesh& mesh, const std::string& name) {
    return disagreement_with_jet(compare_operators(library_mesh(mesh, "indicator_" + name)));
}

TriangleMesh ball_with_a_dent() {
    TriangleMesh mesh = icosphere(3);
    mesh.X.row(100) *= 0.98;
    return mesh;
}

}   // namespace

TEST(ErrorIndicator, IsSmallWhereBothEstimatesAreGood) {
    const Disagreement d = disagreement_on(icosphere(4), "ball");
    EXPECT_LT(d.median, 0.01);
    EXPECT_EQ(d.without_jet, 0);
}

// Uniform H is farther from the jets than cotangent H on uneven triangles, over the same vertices.
TEST(ErrorIndicator, UniformHIsComparedWithTheSameJets) {
    const Disagreement d = disagreement_on(ball_with_a_dent(), "uniform");
    EXPECT_GT(d.rms_uniform, d.rms);
    const CotangentComparison c = compare_operators(library_mesh(ball_with_a_dent(), "indicator_uniform_again"));
    const Vector of_uniform = c.uniform - d.jet;
    EXPECT_NEAR(d.rms_uniform / d.rms, of_uniform.norm() / d.size.norm(), 1e-9);   // all are defined
}

TEST(ErrorIndicator, FindsADent) {
    const TriangleMesh mesh = ball_with_a_dent();
    const Disagreement d = disagreement_on(mesh, "dent");
    Eigen::Index worst = 0;
    d.size.maxCoeff(&worst);
    EXPECT_LT((mesh.X.row(worst) - mesh.X.row(100)).norm(), 0.4);
    EXPECT_GT(d.concentration, 0.5);
    EXPECT_GT(d.rms, 2 * d.median);
}

TEST(ErrorIndicator, SizeIsAnInverseLengthAndTheRestHasNoUnit) {
    const TriangleMesh mesh = ball_with_a_dent();
    TriangleMesh large = mesh;
    large.X *= 8;
    const Disagreement d = disagreement_on(mesh, "small"), D = disagreement_on(large, "large");
    EXPECT_LT((8 * D.size - d.size).cwiseAbs().maxCoeff(), 1e-9 * d.size.maxCoeff());
    EXPECT_NEAR(D.rms, d.rms, 1e-9 * d.rms);
    EXPECT_NEAR(D.concentration, d.concentration, 1e-9);
}

TEST(ErrorIndicator, IsUndefinedOnAFlatMesh) { EXPECT_TRUE(std::isnan(disagreement_on(grid_mesh(8, 8, 1, 1), "grid").rms)); }

// The two rings of a vertex of a tetrahedron are four points, but a cubic has ten coefficients.
TEST(ErrorIndicator, CountsVerticesWithoutJet) {
    TriangleMesh tetrahedron;
    tetrahedron.X.resize(4, 3);
    tetrahedron.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    tetrahedron.F.resize(4, 3);
    tetrahedron.F << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    EXPECT_EQ(disagreement_on(tetrahedron, "tetrahedron").without_jet, 4);
}

TEST(ErrorIndicator, IsTheErrorWhereTheCotangentFormulaFails) {
    int large = 0;
    const MeshLibrary library({}, {});
    const BenchRuns runs = question_runs(library, quick_settings(), no_progress);
    for (const auto& [mesh, on] : indicator_trials(library, runs, quick_settings())) {
        if (on.actual < 0.05) continue;
        ++large;
        EXPECT_NEAR(on.indicated / on.actual, 1, 0.1) << mesh;
        EXPECT_GT(on.found, 0.8) << mesh;
    }
    EXPECT_GE(large, 2);   // random and jittered points
}

TEST(ErrorIndicator, IsShownForAMeshOfTheUsersOwn) {
    const Answer answer = chapter_of_id("q3").answer(library_of(icosphere(3), "indicator_own"), quick_settings(), no_progress);
    const auto found = numbers(table_named(answer.section, "q3_indicator"), "worst tenth found");
    for (const double percent : found) {
        EXPECT_GE(percent, 0);
        EXPECT_LE(percent, 100);
    }
    EXPECT_NE(prose_of(answer.section).find("On indicator_own half of the vertices differ by less than"), std::string::npos);
}

}   // namespace meshfolio::q3_cotangent
