#include "questions/stability/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"

namespace meshfolio::stability {
using namespace testing_tools;

TEST(StabilitySection, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("stability").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_checks_pass(answer.section);
    const report::Table& table = table_named(answer.section, "stability_certificates");
    ASSERT_EQ(table.rows.size(), 8u);
    const auto low = numbers(table, "stable up to λ"), high = numbers(table, "unstable beyond λ");
    for (std::size_t i = 0; i < low.size(); ++i) {
        EXPECT_LT(low[i], high[i]);
        EXPECT_LE(high[i] / low[i] - 1, 1e-8);
    }
}

TEST(StabilitySection, IsWellFormedOnAMeshOfTheUser) {
    const Answer answer =
        chapter_of_id("stability").answer(library_of(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_stab"), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    const output::FigureRequest& modes = figure_named(answer, "stability_top_modes");
    ASSERT_EQ(modes.panels.size(), 2u) << "the whole mesh, and the triangles around its vertex";
    for (const output::Panel& panel : modes.panels) {
        ASSERT_EQ(panel.marked_vertices.size(), 1u);
        EXPECT_NEAR(panel.values[panel.marked_vertices.front()], panel.values.maxCoeff(), 1e-6) << "the ring is where the mode is largest";
        EXPECT_EQ(panel.values.size(), panel.mesh->vertex_count());
    }
}

TEST(StabilitySection, UnitsAreConvertedBothWays) {
    const auto source = library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_units");
    const StabilityStudy study = stability_study(source, quick_settings());
    const report::Table table = unit_table({study});
    const double critical = study.cotangent().critical(), h = mean_edge_length(source->mesh());
    EXPECT_NEAR(step_in_model_units(numbers(table, "λ_crit/h̄²")[0], StepUnit::h2, critical, h) / critical, 1, 1e-14);
    EXPECT_NEAR(step_in_model_units(numbers(table, "0.01 h̄²")[0], StepUnit::tau, critical, h) / (0.01 * h * h), 1, 1e-14);
    EXPECT_NEAR(step_in_model_units(numbers(table, "safe λ")[0], StepUnit::tau, critical, h) / study.cotangent().certificate.lambda_safe(),
                1, 1e-11);
}

// The rows of the uniform operator sum to 2, so its Gershgorin bound is 2 plus counted rounding; the safe step is not printed as 0.9999.
TEST(StabilitySection, ASafeStepOfOneIsPrintedAsOneAndHeadsNameTheirRounding) {
    const report::Table table =
        certificate_table({stability_study(library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_heads"), quick_settings())});
    const std::vector<double> safe = numbers(table, "safe λ");
    EXPECT_EQ(rounded_down(safe[1], 4), 1) << "uniform";
    for (const report::Column& column : table.columns) {
        if (column.unit.find("length²") == std::string::npos) continue;
        EXPECT_TRUE(column.unit.ends_with(column.rounding == report::Column::Rounding::down ? "rounded down" : "rounded up"))
            << column.name;
    }
}

TEST(StabilityStudy, TheTopModeGrowsAndDecaysByTheLaw) {
    const StabilityStudy study = stability_study(library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_law"), quick_settings());
    for (const OperatorLimit& limit : study.limits) {
        EXPECT_NEAR(limit.beyond.factor.back() / std::pow(1.02, 200), 1, 1e-6) << limit.name;
        EXPECT_NEAR(limit.below.factor.back() / std::pow(0.98, 200), 1, 1e-3) << limit.name;
        EXPECT_NEAR(limit.beyond.lambda / limit.critical(), 1.01, 1e-14);
    }
    EXPECT_LE(study.uniform().certificate.mu_high, 2 * (1 + 1e-8));
}

// A vertex close to its neighbour has a small area, large weights and a narrow angle.
TEST(StabilityStudy, FindsTheVertexThatSetsTheLimit) {
    TriangleMesh mesh = icosphere(3);
    const int near = topology_of(mesh).neighbours.begin(100)[0];
    mesh.X.row(100) += 0.95 * (mesh.X.row(near) - mesh.X.row(100));
    const StabilityStudy study = stability_study(library_mesh(mesh, "ball_short_edge"), quick_settings());
    EXPECT_TRUE(study.limiting.vertex == 100 || study.limiting.vertex == near);
    EXPECT_LT(study.limiting.area_share, 0.9);
    EXPECT_GT(study.limiting.stiffness_share, 2);
    EXPECT_LT(study.limiting.smallest_angle, 0.1);
}

TEST(StabilityStudy, AnAdaptiveFlowNeverCrosses) {
    for (const char* role : {"armadillo", "plane_ns"}) {
        const StabilityStudy study = stability_study(MeshLibrary({}, {}).role(role), quick_settings());
        const RebuiltFlow flow = *rebuilt_flow({study}, quick_settings(), no_progress);
        EXPECT_GT(flow.fixed.run.crossing_iteration, 1) << role << ": later on, half the limit of the input exceeds the limit";
        EXPECT_EQ(flow.adaptive.run.crossing_iteration, 0) << role;
        EXPECT_LE(largest_product(flow.adaptive.run), 2 * flow.share) << role;
        EXPECT_LE(flow.adaptive.run.time, flow.fixed.lambda * flow.fixed.iterations * (1 + 1e-12)) << role;
    }
}

// The top mode triples in each step, and reaches a thousand diagonals at the vertex where it is largest.
TEST(StabilityStudy, AFrozenRunBeyondTheLimitBlowsUpAtTheVertexThatSetsIt) {
    const auto source = MeshLibrary({}, {}).role("armadillo");
    const StabilityStudy study = stability_study(source, quick_settings());
    const RebuiltFlow flow = *rebuilt_flow({study}, quick_settings(), no_progress);
    ASSERT_TRUE(flow.frozen.run.blew_up);
    EXPECT_NEAR(largest_product(flow.frozen.run), 4, 1e-6);
    EXPECT_EQ(flow.frozen.run.blow_up_vertex, study.limiting.vertex);
    EXPECT_GT(flow.frozen.turned_iteration, 0);
    EXPECT_LE(flow.frozen.turned_iteration, flow.frozen.run.blow_up_iteration) << "triangles turn over long before";

    const Answer answer = chapter_of_id("stability").answer(library_of(source->mesh(), "beyond"), quick_settings(), no_progress);
    const auto steps = cells(table_named(answer.section, "stability_beyond_flow_table"), "blew up in step");
    EXPECT_EQ(std::get<std::string>(steps.back()), std::to_string(flow.frozen.run.blow_up_iteration));
    EXPECT_NE(prose_of(answer.section)
                  .find("In step " + std::to_string(flow.frozen.run.blow_up_iteration) + " vertex " +
                        std::to_string(study.limiting.vertex) + " is farther than"),
              std::string::npos);
}

TEST(StabilitySection, ACollapsingFlowIsReported) {
    TriangleMesh one{Positions(3, 3), Faces(1, 3)};
    one.X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    one.F << 0, 1, 2;
    const Answer answer = chapter_of_id("stability").answer(library_of(one, "alone"), quick_settings(), no_progress);
    expect_well_formed(answer);
    const std::string prose = prose_of(answer.section);
    EXPECT_NE(prose.find("nothing is left of the surface"), std::string::npos);
    EXPECT_NE(prose.find("Both limits are proved"), std::string::npos);
}

TEST(StabilitySection, TheDiscussionNamesWhyTheLimitingVertexIsFast) {
    const Answer ball = chapter_of_id("stability").answer(library_of(icosphere(2), "even_ball"), quick_settings(), no_progress);
    const std::string even = prose_of(ball.section);
    EXPECT_EQ(even.find("because of"), std::string::npos) << "all triangles are alike";
    TriangleMesh mesh = icosphere(3);
    const int near = topology_of(mesh).neighbours.begin(100)[0];
    mesh.X.row(100) += 0.95 * (mesh.X.row(near) - mesh.X.row(100));
    const std::string pinched =
        prose_of(chapter_of_id("stability").answer(library_of(mesh, "pinched"), quick_settings(), no_progress).section);
    EXPECT_NE(pinched.find("On pinched the fastest is fast because of its large weights"), std::string::npos);
    EXPECT_EQ(pinched.find("no single spot"), std::string::npos);
}

TEST(StabilityFigures, ANeighbourhoodHasTheTrianglesWithinSomeEdges) {
    const TriangleMesh mesh = icosphere(3);
    const MeshTopology topology = topology_of(mesh);
    const Neighbourhood one = neighbourhood(mesh, topology, 200, 1);
    EXPECT_EQ(one.mesh.vertex_count(), topology.neighbours.size(200) + 1);
    EXPECT_EQ(one.mesh.face_count(), topology.neighbours.size(200));
    EXPECT_EQ(one.original[one.vertex], 200);
    const Vector3 normal = vertex_normals(one.mesh).row(one.vertex);
    EXPECT_GT(normal.dot(Vector3(0.53, 0.37, 0.76).normalized()), 0.999) << "towards the viewer";
    EXPECT_NEAR(surface_area(neighbourhood(mesh, topology, 200, 100).mesh) / surface_area(mesh), 1, 1e-12)
        << "the whole mesh, not stretched";
}

TEST(StabilitySection, RealMeshes) { check_real_meshes(chapter_of_id("stability").answer); }

}   // namespace meshfolio::stability
