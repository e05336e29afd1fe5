#include <gtest/gtest.h>

#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/bench_mesh.h"
#include "questions/bench/curvature_subject.h"
#include "questions/core/answer_laws.h"
#include "questions/core/study_laws.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {
using namespace testing_tools;

namespace {

Answer answer_for(const TriangleMesh& mesh, const std::string& name) {
    return chapter_of_id("q1").answer(library_of(mesh, name), quick_settings(), no_progress);
}

/// Returns two grids side by side: open, two components.
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
    ASSERT_EQ(answer.figures.size(), 3u);
    EXPECT_EQ(answer.figures[0].id, "q1_h");
    EXPECT_EQ(answer.figures[1].id, "q1_even");
    EXPECT_EQ(answer.figures[2].id, "q1_tangential");
    for (const output::FigureRequest& figure : answer.figures) {
        EXPECT_EQ(figure.panels.size(), figure.id == "q1_tangential" ? 3u : 4u) << figure.id;   // a plane does not bend
        EXPECT_EQ(figure.view_files, figure.id == "q1_h") << figure.id;
    }
}

/// Returns the panels of H and K of all meshes, from all figures but the tangential one.
std::vector<output::Panel> H_and_K_of(const Answer& answer) {
    std::vector<output::Panel> panels;
    for (const output::FigureRequest& figure : answer.figures)
        if (figure.id != "q1_tangential") panels.insert(panels.end(), figure.panels.begin(), figure.panels.end());
    return panels;
}

// Meshes that look alike from all sides have one view, the others six; H stands beside K of the same mesh.
TEST(Q1, MeshesThatLookAlikeFromAllSidesHaveOneView) {
    const Answer bundled = chapter_of_id("q1").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    EXPECT_EQ(bundled.figures[0].layout, output::Layout::six_views);
    EXPECT_EQ(bundled.figures[1].layout, output::Layout::multiples);
    for (const output::Panel& panel : bundled.figures[1].panels)
        EXPECT_TRUE(panel.label.starts_with("sphere") || panel.label.starts_with("plane")) << panel.label;
    const std::vector<output::Panel> panels = H_and_K_of(bundled);
    for (std::size_t i = 0; i < panels.size(); i += 2) {
        EXPECT_TRUE(panels[i].name.ends_with("_h") && panels[i + 1].name.ends_with("_k")) << panels[i].name;
        EXPECT_EQ(panels[i].mesh->X, panels[i + 1].mesh->X);
    }
    const Answer alone = answer_for(icosphere(2), "alone1");   // the assignment asks for six views
    EXPECT_EQ(alone.figures[0].id, "q1_h");
    EXPECT_EQ(alone.figures[0].layout, output::Layout::six_views);
}

// The caption mentions rings only if there are some, and names their meshes.
TEST(Q1, CaptionsNameTheMeshesWithRings) {
    const auto captions_of = [](const Answer& answer) {
        std::string captions;
        for (const report::Block& block : answer.section.blocks)
            if (const auto* figure = std::get_if<report::Figure>(&block)) captions += figure->caption;
        return captions;
    };
    const Answer bundled = chapter_of_id("q1").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    std::size_t ringed = 0;
    for (const output::Panel& panel : H_and_K_of(bundled)) {
        ringed += panel.marked_vertices.empty() ? 0 : 1;
        EXPECT_LE(20 * panel.marked_vertices.size(), static_cast<std::size_t>(panel.mesh->vertex_count())) << panel.name;
    }
    ASSERT_EQ(ringed, 1u);
    EXPECT_NE(captions_of(bundled).find("Rings mark vertices of sphere with"), std::string::npos) << captions_of(bundled);
    EXPECT_NE(captions_of(answer_for(icosphere(3), "rings1")).find("Rings mark vertices of rings1"), std::string::npos);
    EXPECT_EQ(captions_of(answer_for(grid_mesh(8, 8, 1, 1), "no_rings1")).find("Rings"), std::string::npos);
}

// One figure shows meshes of all sizes and curvatures: each fills its frame, and each has colours or is zero.
TEST(Q1, EachMeshHasARangeOfItsOwn) {
    const Answer answer = chapter_of_id("q1").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    for (const output::FigureRequest& figure : answer.figures) {
        if (figure.id == "q1_tangential") continue;
        EXPECT_FALSE(figure.range);
    }
    for (const output::Panel& panel : H_and_K_of(answer)) {
        EXPECT_NEAR(panel.mesh->X.rowwise().norm().maxCoeff(), 1, 1e-12) << panel.name;
        const double most = panel.values.array().isFinite().select(panel.values.array().abs(), 0).maxCoeff();
        const bool zero = panel.label.find("at most") != std::string::npos;
        ASSERT_TRUE(panel.range) << panel.name;
        const output::ColorRange& range = *panel.range;
        EXPECT_EQ(range.low, -range.high);
        EXPECT_EQ(range.unit, panel.name.ends_with("_k") ? "1/length²" : "% of h̄");
        const double beyond = share_beyond(panel.values, range.high);
        EXPECT_LT(beyond, 0.05) << panel.name;
        EXPECT_NEAR(range.clipped_below + range.clipped_above, beyond, 1e-12) << panel.name;
        EXPECT_EQ(most < 0.01 * range.high, zero) << panel.name;
        if (!zero) {
            EXPECT_GE(most, 0.799 * range.high) << panel.name;   // where all are nearly equal
        }
    }
}

// Without a curved mesh the text does not mention drift.
TEST(Q1, TheDriftMapShowsTheMeshWithTheLargestDrift) {
    TriangleMesh uneven = icosphere(3);
    uneven.X = jittered(uneven, topology_of(uneven), 0.2, 1, [](const Vector3& p) { return p.normalized(); });
    const Answer ball = answer_for(uneven, "uneven1");
    EXPECT_TRUE(says(ball, "is drift.")) << prose_of(ball.section);
    EXPECT_EQ(ball.figures.back().id, "q1_tangential");
    const Answer sheet = answer_for(grid_mesh(8, 8, 1, 1), "sheet1");
    EXPECT_EQ(sheet.figures.size(), 1u);
    EXPECT_FALSE(says(sheet, "Where the error sits"));
}

TEST(Q1, TheTextFollowsTheData) {
    const Answer ball = answer_for(icosphere(3), "body1"), sheet = answer_for(grid_mesh(8, 8, 1, 1), "body1");
    EXPECT_TRUE(says(sheet, "flat with symmetric inner rings"));
    EXPECT_TRUE(says(sheet, "1.000 full turns"));
    EXPECT_FALSE(says(ball, "is flat"));
    EXPECT_TRUE(says(ball, "at the 12 vertices with other than six edges"));
    EXPECT_TRUE(says(ball, "The area makes the difference"));
    EXPECT_EQ(ball.figures[0].panels.back().marked_vertices.size(), 12u);
}

// The normals of the mesh are used, as in the paper; with exact normals the normal part would be exact.
TEST(Q1, TheNormalPartUsesTheNormalOfTheMesh) {
    const Answer answer = answer_for(icosphere(1), "normal1");
    const auto parts = numbers(table_named(answer.section, "q1_errors"), "normal part");
    ASSERT_EQ(parts.size(), 6u);
    for (const double percent : parts) EXPECT_GT(percent, 0.01);
    EXPECT_FALSE(says(answer, "exact on spheres"));
}

// A steep hill stands on an irregular plane, where K is white and H is coloured by drift.
TEST(Q1, ColoursOfFlatPartsAreExplainedAsDrift) {
    TriangleMesh hill = grid_mesh(30, 30, 1, 1);
    hill.X = jittered(hill, topology_of(hill), 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    for (auto x : hill.X.rowwise()) x[2] = 0.1 * std::exp(-60 * (std::pow(x[0] - 0.5, 2) + std::pow(x[1] - 0.5, 2)));
    const Answer answer = answer_for(hill, "hill1");
    EXPECT_TRUE(says(answer, "is flat: K and cotangent H stay below a tenth of their scales")) << prose_of(answer.section);
    EXPECT_FALSE(says(answer_for(icosphere(3), "nothing_flat1"), "is flat: K and cotangent H"));
}

// Half of the vertices of a hill on a nearly flat field have K < 0, but the picture shows none of it: the text says both.
TEST(Q1, NegativeKIsCountedEvenIfPale) {
    TriangleMesh hill = grid_mesh(30, 30, 1, 1);
    NormalNumbers random(3);
    for (Eigen::Index v = 0; v < hill.X.rows(); ++v) {
        const double x = hill.X(v, 0) - 0.5, y = hill.X(v, 1) - 0.5;
        hill.X(v, 2) = 0.3 * std::exp(-30 * (x * x + y * y)) + 1e-5 * random.next();
    }
    const MeshCurvature c = curvature_of(library_mesh(hill, "hill"));
    const double below = double((c.K.array() < 0).count()) / double(c.K.array().isFinite().count());
    const Answer answer = answer_for(hill, "hill");
    EXPECT_TRUE(says(answer, "with K < 0 is " + readable_percent(below, 2) + " on hill")) << prose_of(answer.section);
    EXPECT_TRUE(says(answer, "|K| is below a twentieth of its scale and looks white"));
}

TEST(Q1, TangentialDriftOnAnIrregularPlaneIsReported) {
    TriangleMesh mesh = grid_mesh(9, 9, 1, 1);
    mesh.X = jittered(mesh, topology_of(mesh), 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    const Answer answer = answer_for(mesh, "irregular_plane");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_TRUE(says(answer, "is flat, yet it has colours"));
}

TEST(Q1, OpenMeshesOfSeveralComponentsAreAnswered) {
    const Answer answer = answer_for(two_sheets(), "two_sheets");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q1, AMeshWithoutInnerVerticesHasNoCurvature) {
    const Answer flat = answer_for(one_triangle(), "triangle");
    expect_well_formed(flat);
    expect_checks_pass(flat.section);
    TriangleMesh hinge = grid_mesh(2, 2, 1, 1);
    hinge.X(3, 2) = 1;
    const Answer bent = answer_for(hinge, "hinge");
    expect_well_formed(bent);
    EXPECT_TRUE(says(bent, "no curvature is defined"));
}

TEST(Q1, APictureOfTwelveVerticesIsNotDescribed) {
    const Answer answer = answer_for(icosphere(0), "few1");
    EXPECT_TRUE(says(answer, "has too few vertices")) << prose_of(answer.section);
    EXPECT_FALSE(says(answer, "rank correlation"));
}

TEST(Q1, EveryRealMesh) { check_real_meshes(chapter_of_id("q1").answer, quick_settings(), any_size); }

}   // namespace meshfolio::q1_uniform
