#include "questions/stability_section.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/stability_figures.h"
#include "questions/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

TEST(StabilitySection, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = answer_stability(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_checks_pass(answer.section);
    const report::Table& table = table_named(answer.section, "stability_certificates");
    ASSERT_EQ(table.rows.size(), 8u);
    const auto low = numbers(table, "proved stable up to λ"), high = numbers(table, "proved unstable beyond λ");
    for (std::size_t i = 0; i < low.size(); ++i) {
        EXPECT_LT(low[i], high[i]);
        EXPECT_LE(high[i] / low[i] - 1, 1e-8);
    }
}

TEST(StabilitySection, WellFormedOnAMeshOfOnesOwn) {
    const Answer answer = answer_stability(library_of(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_stab"), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    ASSERT_EQ(answer.figures.size(), 2u);
    for (const output::FigureRequest& figure : answer.figures) {
        ASSERT_EQ(figure.panels.size(), 1u);
        const output::Panel& panel = figure.panels.front();
        ASSERT_EQ(panel.marked_vertices.size(), 1u);
        EXPECT_NEAR(panel.values[panel.marked_vertices.front()], panel.values.maxCoeff(), 1e-6) << "the ring is where the mode is largest";
        EXPECT_EQ(panel.values.size(), panel.mesh->vertex_count());
    }
}

TEST(StabilitySection, UnitsAreConvertedBothWays) {
    const auto source = library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_units");
    const StabilityStudy study = stability_study(source, quick_settings());
    const report::Table table = unit_table({study});
    const auto raw = numbers(table, "λ"), tau = numbers(table, "τ"), h2 = numbers(table, "λ/h̄²");
    EXPECT_NEAR(tau[0], 1, 1e-14) << "the limit";
    EXPECT_NEAR(tau[1], 0.5, 1e-14);
    EXPECT_NEAR(h2[3], 0.01, 1e-15);
    const double critical = study.cotangent.critical(), h = mean_edge_length(source->mesh());
    for (std::size_t i = 0; i < raw.size(); ++i) {
        EXPECT_NEAR(step_in_model_units(tau[i], StepUnit::tau, critical, h) / raw[i], 1, 1e-14);
        EXPECT_NEAR(step_in_model_units(h2[i], StepUnit::h2, critical, h) / raw[i], 1, 1e-14);
        EXPECT_EQ(step_in_model_units(raw[i], StepUnit::raw, critical, h), raw[i]);
    }
}

TEST(StabilityStudy, GrowsAndDecaysByTheLaw) {
    const StabilityStudy study = stability_study(library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_law"), quick_settings());
    for (const OperatorLimit* limit : study.operators()) {
        EXPECT_NEAR(limit->beyond.factor.back() / std::pow(1.02, 300), 1, 1e-6) << limit->name;
        EXPECT_NEAR(limit->below.factor.back() / std::pow(0.98, 300), 1, 1e-3) << limit->name;
        EXPECT_NEAR(limit->beyond.lambda / limit->critical(), 1.01, 1e-14);
    }
    EXPECT_LE(study.uniform.certificate.mu_high, 2 * (1 + 1e-8));
}

// One vertex moved next to its neighbour: small area, large weights, a narrow angle.
TEST(StabilityStudy, NamesTheVertexThatSetsTheLimit) {
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
        const RebuiltFlow flow = rebuilt_flow(study, quick_settings());
        EXPECT_GT(flow.fixed.crossing_iteration, 1) << role << ": half the limit of the input is too much later on";
        EXPECT_EQ(flow.adaptive.crossing_iteration, 0) << role;
        EXPECT_LE(largest_product(flow.adaptive), 2 * flow.share) << role;
        EXPECT_LE(flow.adaptive.time, flow.lambda * flow.iterations * (1 + 1e-12)) << role;
    }
}

TEST(StabilityFigures, ANeighbourhoodIsWhatLiesWithinSoManyEdges) {
    const TriangleMesh mesh = icosphere(3);
    const MeshTopology topology = topology_of(mesh);
    const Neighbourhood one = neighbourhood(mesh, topology, 200, 1);
    EXPECT_EQ(one.mesh.vertex_count(), topology.neighbours.size(200) + 1);
    EXPECT_EQ(one.mesh.face_count(), topology.neighbours.size(200));
    EXPECT_EQ(one.original[one.vertex], 200);
    const Vector3 normal = vertex_normals(one.mesh).row(one.vertex);
    EXPECT_GT(normal.dot(Vector3(0.53, 0.37, 0.76).normalized()), 0.999) << "towards the viewer";
    EXPECT_NEAR(surface_area(neighbourhood(mesh, topology, 200, 100).mesh) / surface_area(mesh), 1, 1e-12) << "all of it, not stretched";
}

TEST(StabilitySection, RealMeshes) { check_real_meshes(answer_stability); }
