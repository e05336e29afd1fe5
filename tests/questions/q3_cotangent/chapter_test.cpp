#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/curvature_bench.h"
#include "questions/core/answer_laws.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {
using namespace testing_tools;

namespace {

Answer answer_for(const TriangleMesh& mesh, const std::string& name) {
    return chapter_of_id("q3").answer(library_of(mesh, name), quick_settings(), no_progress);
}

bool says(const Answer& answer, const std::string& words) { return prose_of(answer.section).find(words) != std::string::npos; }

}   // namespace

TEST(Q3, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("q3").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

// The good estimate sets the colours; the caption says how much of the bad one lies beyond them.
TEST(Q3, EachMeshIsShownByBothOperatorsInTheRangeOfTheCotangentOne) {
    const Answer answer = chapter_of_id("q3").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    ASSERT_EQ(answer.figures.size(), 4u);   // then the irregular plane and where H is to be doubted; on a flat mesh it is not
    EXPECT_EQ(answer.figures[3].id, "q3_lily_disagreement");
    for (std::size_t f = 0; f < 2; ++f) {
        const output::FigureRequest& figure = answer.figures[f];
        ASSERT_EQ(figure.panels.size(), 2u);
        EXPECT_TRUE(figure.view_files);
        ASSERT_TRUE(figure.range.has_value());
        EXPECT_EQ(figure.range->low, -figure.range->high);
        const output::ColorRange own = output::robust_range({figure.panels[1]}, "diverging", "", "", 0.01);
        EXPECT_EQ(figure.range->high, own.high) << figure.id;
    }
    const Vector& uniform = answer.figures[0].panels[0].values;
    EXPECT_GT(beyond_range(uniform, *answer.figures[0].range), 0.05);
    EXPECT_TRUE(says(answer, "Uniform H lies beyond them at"));
}

TEST(Q3, TheSmallestWeightIsThatOfAnEdge) {
    const TriangleMesh ball = icosphere(2);
    const MeshTopology topology = topology_of(ball);
    const NegativeWeights weights = negative_weights(laplace_beltrami(ball).C, topology);
    EXPECT_EQ(weights.inside, 0);
    EXPECT_GT(weights.smallest, 0.1);   // not 0, where none is negative
    EXPECT_LT(weights.smallest, 1);
}

TEST(Q3, ItsExtentIsThatOfTheLargestMesh) {
    int most = 0;
    for (const KnownSurface& surface : question_surfaces())
        most = std::max(most, bench_mesh(surface, MeshKind::regular, refinement_levels(true).back(), 1).mesh.vertex_count());
    const Answer answer = answer_for(icosphere(1), "small3");
    EXPECT_NE(answer.section.extent.find("up to " + std::to_string(most) + " vertices"), std::string::npos) << answer.section.extent;
}

TEST(Q3, TheTextFollowsTheData) {
    const Answer ball = answer_for(icosphere(3), "body3"), sheet = answer_for(grid_mesh(8, 8, 1, 1), "body3");
    EXPECT_TRUE(says(sheet, "cotangents improve nothing"));
    EXPECT_FALSE(says(ball, "is flat"));
    EXPECT_TRUE(says(ball, "no weight is negative"));
}

TEST(Q3, OnAnIrregularPlaneTheImprovementIsMeasured) {
    TriangleMesh mesh = grid_mesh(9, 9, 1, 1);
    mesh.X = jittered(mesh, topology_of(mesh), 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    const Answer answer = answer_for(mesh, "irregular_plane3");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_TRUE(says(answer, "every colour in"));
}

TEST(Q3, MeshesWithoutInnerVerticesAreAnswered) {
    TriangleMesh hinge = grid_mesh(2, 2, 1, 1);
    const Answer flat = answer_for(hinge, "square3");
    expect_well_formed(flat);
    hinge.X(3, 2) = 1;
    const Answer bent = answer_for(hinge, "hinge3");
    expect_well_formed(bent);
    EXPECT_TRUE(says(bent, "there is nothing to compare"));
}

TEST(Q3, EveryRealMesh) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        SCOPED_TRACE(file);
        const Answer answer = chapter_of_id("q3").answer(MeshLibrary({}, {file}), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

}   // namespace meshfolio::q3_cotangent
