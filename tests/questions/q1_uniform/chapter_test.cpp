#include <gtest/gtest.h>

#include <map>

#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/bench_mesh.h"
#include "questions/core/answer_laws.h"

namespace meshfolio::q1_uniform {
using namespace testing_tools;

namespace {

Answer answer_for(const TriangleMesh& mesh, const std::string& name) {
    return chapter_of_id("q1").answer(library_of(mesh, name), quick_settings(), no_progress);
}

/// Two grids side by side: open, two components.
TriangleMesh two_sheets() {
    const TriangleMesh one = grid_mesh(5, 4, 1, 1, [](double x, double y) { return x * y; });
    const int n = one.vertex_count(), m = one.face_count();
    TriangleMesh both;
    both.X.resize(2 * n, 3);
    both.X << one.X, (one.X.array() + 3).matrix();
    both.F.resize(2 * m, 3);
    both.F << one.F, (one.F.array() + n).matrix();
    return both;
}

TriangleMesh one_triangle() {
    TriangleMesh mesh;
    mesh.X.resize(3, 3);
    mesh.X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    mesh.F.resize(1, 3);
    mesh.F << 0, 1, 2;
    return mesh;
}

bool says(const Answer& answer, const std::string& words) { return prose_of(answer.section).find(words) != std::string::npos; }

}   // namespace

TEST(Q1, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("q1").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(answer.figures.size(), 8u);   // two quantities on four meshes
    for (const output::FigureRequest& figure : answer.figures) EXPECT_EQ(figure.turnable, figure.id.ends_with("_h")) << figure.id;
}

TEST(Q1, OneColourRangeAQuantity) {
    const Answer answer = chapter_of_id("q1").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    std::map<std::string, double> highest;
    for (const output::FigureRequest& figure : answer.figures) {
        const auto [entry, is_new] = highest.try_emplace(figure.range->quantity, figure.range->high);
        EXPECT_EQ(entry->second, figure.range->high) << figure.id;
        EXPECT_EQ(figure.range->low, -figure.range->high) << figure.id;
    }
    EXPECT_EQ(highest.size(), 2u);
}

TEST(Q1, TheTextFollowsTheData) {
    const Answer ball = answer_for(icosphere(3), "body1"), sheet = answer_for(grid_mesh(8, 8, 1, 1), "body1");
    EXPECT_TRUE(says(sheet, "is flat"));
    EXPECT_TRUE(says(sheet, "Every inner ring is symmetric"));
    EXPECT_TRUE(says(sheet, "1.000 full turns"));
    EXPECT_FALSE(says(ball, "is flat"));
    EXPECT_TRUE(says(ball, "K is negative at 0"));
}

TEST(Q1, TangentialDriftOnAnIrregularPlaneIsNamed) {
    TriangleMesh mesh = grid_mesh(9, 9, 1, 1);
    mesh.X = jittered(mesh, topology_of(mesh), 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    const Answer answer = answer_for(mesh, "irregular_plane");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_TRUE(says(answer, "asymmetric ring points along the plane"));
}

TEST(Q1, OpenMeshesOfSeveralComponentsAreAnswered) {
    const Answer answer = answer_for(two_sheets(), "two_sheets");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q1, AMeshThatIsAllBoundaryHasNoCurvature) {
    const Answer flat = answer_for(one_triangle(), "triangle");
    expect_well_formed(flat);
    expect_checks_pass(flat.section);
    TriangleMesh hinge = grid_mesh(2, 2, 1, 1);
    hinge.X(3, 2) = 1;
    const Answer bent = answer_for(hinge, "hinge");
    expect_well_formed(bent);
    EXPECT_TRUE(says(bent, "no curvature is defined anywhere"));
}

TEST(Q1, EveryRealMesh) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        SCOPED_TRACE(file);
        const Answer answer = chapter_of_id("q1").answer(MeshLibrary({}, {file}), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

}   // namespace meshfolio::q1_uniform
