#include <gtest/gtest.h>

#include <algorithm>

#include "base/number_text.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/curvature_bench.h"
#include "questions/bench/estimators.h"
#include "questions/core/study_laws.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {
using namespace testing_tools;

namespace {

Answer answer_for(const TriangleMesh& mesh, const std::string& name) {
    return chapter_of_id("q3").answer(library_of(mesh, name), quick_settings(), no_progress);
}

bool says(const Answer& answer, const std::string& words) { return prose_of(answer.section).find(words) != std::string::npos; }

}   // namespace

// Cotangent H sets the colours; the caption says how much of uniform H lies beyond them.
TEST(Q3, BothOperatorsAreShownInTheRangeOfTheCotangentOne) {
    const Answer answer = chapter_of_id("q3").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    ASSERT_EQ(answer.figures.size(), 3u);             // then flat meshes, and where H is to be doubted; on a flat mesh it is not
    EXPECT_EQ(answer.figures[1].panels.size(), 4u);   // the plane and the irregular square
    EXPECT_EQ(answer.figures[2].id, "q3_lily_disagreement");
    const output::FigureRequest& figure = answer.figures[0];
    ASSERT_EQ(figure.panels.size(), 4u);
    EXPECT_TRUE(figure.view_files);
    const auto end = [&](std::size_t panel) { return figure.panels[panel].range->high; };
    EXPECT_EQ(end(0), end(1)) << "that of cotangent H";
    EXPECT_EQ(end(3), end(1));
    EXPECT_GT(end(2), end(1));
    const auto beyond = [&](std::size_t panel) { return share_beyond(figure.panels[panel].values, end(panel)); };
    EXPECT_GT(beyond(0), 0.2);    // lily, uniform
    EXPECT_LT(beyond(1), 0.05);   // lily, cotangent
    EXPECT_LT(beyond(2), 0.05);   // lily, uniform, on its own scale
    EXPECT_LT(beyond(3), 0.2);    // lily, jets
    EXPECT_EQ(figure.panels[0].values.size(), figure.panels[2].values.size());
    EXPECT_TRUE(says(answer, "where uniform H lies beyond the colours is"));
    EXPECT_FALSE(figure.range) << "each panel has its own";
    const output::ColorRange& range = *figure.panels[0].range;
    EXPECT_NEAR(range.clipped_below + range.clipped_above, beyond(0), 1e-12);
}

// The answer gives the least gain if cotangent H always wins clearly, else the number of meshes where it wins.
TEST(Q3, TheAnswerFollowsTheErrors) {
    BenchRuns runs = question_runs(MeshLibrary({}, {}), quick_settings(), no_progress);
    const auto message = [&] { return report::plain(answer_of(runs)); };
    const auto set = [](BenchRun& run, double uniform) {   // times the error of cotangent H
        auto& errors = run.levels.back().errors;
        errors["H.uniform"].l2 = uniform * errors[H_with(areas_used)].l2;
    };
    for (BenchRun& run : runs) set(run, 5000);
    set(runs.back(), 199);
    EXPECT_NE(message().find("errs at least 100 times less"), std::string::npos) << message();
    set(runs.back(), 1.1);
    EXPECT_NE(message().find("nearer to the truth than uniform H on 6 of 6"), std::string::npos) << message();
    set(runs.back(), 0.5);
    EXPECT_NE(message().find("on 5 of 6"), std::string::npos) << message();
    for (BenchRun& run : runs) set(run, 0.5);
    EXPECT_EQ(message().rfind("Hardly", 0), 0u) << message();
}

TEST(Q3, AColumnOfZerosIsLeftOut) {
    const Answer answer = answer_for(icosphere(1), "columns3");
    for (const report::Column& column : table_named(answer.section, "q3_errors_l2").columns) {
        if (column.name != "without H") continue;
        const auto undefined = numbers(table_named(answer.section, "q3_errors_l2"), "without H");
        EXPECT_GT(*std::ranges::max_element(undefined), 0);
    }
}

TEST(Q3, TheSmallestWeightBelongsToAnEdge) {
    const TriangleMesh ball = icosphere(2);
    const MeshTopology topology = topology_of(ball);
    const NegativeWeights weights = negative_weights(laplace_beltrami(ball).C, topology);
    EXPECT_EQ(weights.inside, 0);
    EXPECT_GT(weights.smallest, 0.1);   // not 0, where none is negative
    EXPECT_LT(weights.smallest, 1);
}

TEST(Q3, TheExtentNamesTheLargestMesh) {
    int most = 0;
    for (const KnownSurface& surface : {known_surface("sphere"), known_surface("ellipsoid"), known_surface("torus")})
        most = std::max(most, bench_mesh(surface, MeshKind::regular, refinement_levels(true).back(), 1).mesh.vertex_count());
    const Answer answer = answer_for(icosphere(1), "small3");
    EXPECT_NE(answer.section.extent.find("up to " + readable_count(most) + " vertices"), std::string::npos) << answer.section.extent;
}

TEST(Q3, TheTextFollowsTheData) {
    const Answer ball = answer_for(icosphere(3), "body3"), sheet = answer_for(grid_mesh(8, 8, 1, 1), "body3");
    EXPECT_TRUE(says(sheet, "On body3 the rings are symmetric, so both operators read 0"));
    EXPECT_FALSE(says(sheet, "Uniform beside cotangent H"));
    EXPECT_FALSE(says(ball, "the rings are symmetric"));
    EXPECT_TRUE(says(ball, "no weight is negative"));
}

// plane.obj of the course has coordinates of six decimals; uniform weights show the rounding, cotangents do not.
TEST(Q3, RoundedCoordinatesAreMentionedIfVisible) {
    TriangleMesh grid = grid_mesh(9, 9, 1, 1);
    const Answer exact = answer_for(grid, "exact3");
    grid.X = (1e6 / 3 * grid.X.array()).round() / 1e6;
    const Answer rounded = answer_for(grid, "rounded3");
    EXPECT_FALSE(says(exact, "shows the rounding of the file's coordinates"));
    EXPECT_TRUE(says(rounded, "shows the rounding of the file's coordinates")) << prose_of(rounded.section);
}

TEST(Q3, TheImprovementOnAnIrregularPlaneIsMeasured) {
    TriangleMesh mesh = grid_mesh(9, 9, 1, 1);
    mesh.X = jittered(mesh, topology_of(mesh), 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    const Answer answer = answer_for(mesh, "irregular_plane3");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_TRUE(says(answer, "On irregular_plane3 uniform H reaches"));
}

/// A flat grid in which one side of an edge between inner vertices has a vertex more than the other; a triangle without area fills the
/// slit.
TriangleMesh grid_with_a_slit() {
    TriangleMesh mesh = grid_mesh(6, 6, 1, 1);
    const MeshTopology topology = topology_of(mesh);
    const auto inside = [&](int v) { return !topology.on_boundary[static_cast<std::size_t>(v)]; };
    for (int t = 0; t < mesh.face_count(); ++t) {
        const int a = mesh.F(t, 0), b = mesh.F(t, 1), c = mesh.F(t, 2), m = mesh.vertex_count();
        if (!inside(a) || !inside(b)) continue;
        mesh.X.conservativeResize(m + 1, 3);
        mesh.X.row(m) = 0.5 * (mesh.X.row(a) + mesh.X.row(b));
        const int n = mesh.face_count();
        mesh.F.conservativeResize(n + 2, 3);
        mesh.F.row(t) << a, m, c;
        mesh.F.row(n) << m, b, c;
        mesh.F.row(n + 1) << a, b, m;
        return mesh;
    }
    return mesh;
}

// The rings do not close, and no operator can repair that: the check of the cotangent operator does not fail.
TEST(Q3, TrianglesWithoutAreaLeaveTheFlatCheckUndecided) {
    const Answer answer = answer_for(grid_with_a_slit(), "slit3");
    const auto flat =
        std::ranges::find_if(answer.section.checks, [](auto& c) { return c.name.find("the flat slit3") != std::string::npos; });
    ASSERT_NE(flat, answer.section.checks.end());
    EXPECT_EQ(flat->status, report::Check::Status::undecided) << flat->measured;
    EXPECT_GT(flat->measured, 1e-3);
    EXPECT_NE(flat->note.find("without area"), std::string::npos);
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

TEST(Q3, EveryRealMesh) { check_real_meshes(chapter_of_id("q3").answer, quick_settings(), any_size); }

}   // namespace meshfolio::q3_cotangent
