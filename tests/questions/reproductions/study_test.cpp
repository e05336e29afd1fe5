#include "questions/reproductions/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/curvature/curvature.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_laws.h"
#include "temporary_folder.h"

namespace meshfolio::reproductions {
using namespace testing_tools;

namespace {

const OriginalMesh missing_ball{"ball", "no_such_ball.off", "sphere.obj", 2e-3, 0.05, 3.5};

/// An experiment on a ball with the limit 2e-3 and the mean edge 0.05; the bundled sphere stands in for it.
Experiment experiment_of(ExperimentKind kind) {
    Experiment e;
    e.rows = {20};
    e.from = "S0";
    e.name = "x";
    e.kind = kind;
    e.meshes = {missing_ball};
    e.lambda = {1e-3};
    e.iterations = {5};
    return e;
}

const MeshLibrary bundled_meshes({}, {});

}   // namespace

TEST(ExperimentNames, AreReadBackAndUnknownOnesAreRefused) {
    for (const std::string& name : experiment_kind_names()) EXPECT_EQ(name_of(experiment_kind_named(name)), name);
    for (const std::string& name : smoothing_method_names()) EXPECT_EQ(name_of(smoothing_method_named(name)), name);
    for (const std::string& name : noise_unit_names()) EXPECT_EQ(name_of(noise_unit_named(name)), name);
    for (const std::string& name : experiment_colour_names()) EXPECT_EQ(name_of(experiment_colour_named(name)), name);
    EXPECT_THROW(smoothing_method_named("explict"), UsageError);
}

TEST(ExperimentMeshes, StandInsAreReportedAndSharedOnesAppearOnce) {
    Experiment e = experiment_of(ExperimentKind::curvature);
    OriginalMesh other = missing_ball;
    other.name = "globe";
    other.file = "globe.off";
    OriginalMesh block{"block", "", "cube.obj", 0, 0, 0};
    e.meshes = {missing_ball, other, block};
    const auto meshes = experiment_meshes(bundled_meshes, e, {});
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_TRUE(meshes[0].stand_in && meshes[1].stand_in);
    EXPECT_EQ(meshes[0].originals.size(), 2u);
    EXPECT_EQ(meshes[0].used->input.asked, "no_such_ball.off");
    EXPECT_EQ(meshes[1].used->input.asked, "block");
    EXPECT_EQ(meshes[1].name, "cube");
    EXPECT_NEAR(meshes[0].mean_edge, mean_edge_length(meshes[0].mesh()), 1e-15);
}

TEST(ExperimentMeshes, TheOriginalIsUsedIfItIsThere) {
    const TemporaryFolder folder;
    write_mesh(folder.path() / "no_such_ball.off", ellipsoid_mesh(1, {1, 1, 1}));
    const MeshLibrary library({folder.path()}, {});
    const auto meshes = experiment_meshes(library, experiment_of(ExperimentKind::smoothing), {});
    EXPECT_FALSE(meshes.at(0).stand_in);
    EXPECT_EQ(meshes[0].mesh().vertex_count(), 42);
    const Experiment e = experiment_of(ExperimentKind::smoothing);
    EXPECT_EQ(lambda_on(e, meshes[0], OperatorKind::cotan, 1e-3, 7), 1e-3) << "raw is raw on the original";
}

TEST(ExperimentMeshes, AWholePathWinsOverABareNameInAnEarlierFolder) {
    const TemporaryFolder flat, deep;
    std::filesystem::create_directory(deep.path() / "parts");
    write_mesh(flat.path() / "a.obj", ellipsoid_mesh(1, {1, 1, 1}));
    write_mesh(deep.path() / "parts" / "a.obj", ellipsoid_mesh(2, {1, 1, 1}));
    const MeshLibrary library({flat.path(), deep.path()}, {});
    EXPECT_EQ(library.original("a", "parts/a.obj", "cube.obj", {})->mesh().vertex_count(), 162);
    EXPECT_EQ(library.original("a", "b.obj", "cube8.obj", {})->mesh().vertex_count(), 8);
}

TEST(ExperimentMeshes, AMeshAndTheStandInOfAnotherAreDistinguished) {
    const TemporaryFolder folder;
    write_mesh(folder.path() / "cube.obj", ellipsoid_mesh(1, {1, 1, 1}));
    Experiment e = experiment_of(ExperimentKind::curvature);
    e.meshes = {{"a", "cube.obj", "sphere.obj", 0, 0, 0}, {"b", "no_such.obj", "cube.obj", 0, 0, 0}};
    const auto meshes = experiment_meshes(MeshLibrary({folder.path()}, {}), e, {});
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[0].name, "cube");
    EXPECT_EQ(meshes[1].name, "cube_2");
}

TEST(ExperimentMeshes, TheUsersMeshTakesEveryPlace) {
    Experiment e = experiment_of(ExperimentKind::smoothing);
    e.meshes.push_back({"block", "", "cube.obj", 0, 0, 0});
    const MeshLibrary own = library_of(ellipsoid_mesh(1, {1, 1, 1}), "mine");
    const auto meshes = experiment_meshes(own, e, {});
    ASSERT_EQ(meshes.size(), 1u);
    EXPECT_EQ(meshes[0].name, "mine");
    EXPECT_TRUE(meshes[0].stand_in);
}

TEST(ExperimentParameters, CarryOverByTheirRules) {
    Experiment e = experiment_of(ExperimentKind::smoothing);
    const ExperimentMesh mesh = experiment_meshes(bundled_meshes, e, {}).at(0);
    const double critical = largest_stable_step(largest_eigenvalue(laplace_beltrami(mesh.mesh())));
    EXPECT_NEAR(lambda_on(e, mesh, OperatorKind::cotan, 1e-3, critical) / critical, 0.5, 1e-9) << "half the limit there and here";
    EXPECT_NEAR(lambda_on(e, mesh, OperatorKind::cotan_no_half, 1e-3, critical / 2) / critical, 0.5, 1e-9) << "the same λ";
    EXPECT_EQ(lambda_on(e, mesh, OperatorKind::uniform, 1e-3, 1.3), 1e-3) << "no unit, nothing to carry";
    e.lambda_unit = StepUnit::tau;
    EXPECT_NEAR(lambda_on(e, mesh, OperatorKind::cotan, 0.25, 8), 2, 1e-15);
    e.lambda_unit = StepUnit::h2;
    EXPECT_NEAR(lambda_on(e, mesh, OperatorKind::cotan, 0.25, 8), 0.25 * mesh.mean_edge * mesh.mean_edge, 1e-15);

    Experiment noisy = experiment_of(ExperimentKind::denoising);
    EXPECT_NEAR(lambda_on(noisy, mesh, OperatorKind::cotan, 2.5e-3, 8) / (mesh.mean_edge * mesh.mean_edge), 1, 1e-12);
    EXPECT_NEAR(noise_on(noisy, mesh, 0.01).x() / mesh.mean_edge, 0.2, 1e-12);
    noisy.noise_unit = NoiseUnit::box;
    EXPECT_NEAR((noise_on(noisy, mesh, 0.01) - 0.01 * mesh.extent).norm(), 0, 1e-15);
    noisy.noise_unit = NoiseUnit::diagonal;
    EXPECT_NEAR(noise_on(noisy, mesh, 0.01).y(), 0.01 * mesh.diagonal, 1e-15);
    noisy.noise_unit = NoiseUnit::edge;
    EXPECT_NEAR(noise_on(noisy, mesh, 0.01).z(), 0.01 * mesh.mean_edge, 1e-15);
}

TEST(ExperimentParameters, StayAsGivenIfTheOriginalIsNotMeasured) {
    Experiment e = experiment_of(ExperimentKind::smoothing);
    e.meshes[0].lambda_crit = e.meshes[0].mean_edge = 0;
    const ExperimentMesh mesh = experiment_meshes(bundled_meshes, e, {}).at(0);
    EXPECT_EQ(lambda_rule(e, mesh, OperatorKind::cotan), Carried::as_given);
    EXPECT_EQ(lambda_on(e, mesh, OperatorKind::cotan, 1e-3, 8), 1e-3);
    e.kind = ExperimentKind::denoising;
    EXPECT_EQ(noise_rule(e, mesh), Carried::as_given);
    EXPECT_EQ(noise_on(e, mesh, 0.5).x(), 0.5);
}

// On a stand-in of the bunny λ = 1e-7 is within the limit of C with the factor ½, and beyond it without the factor.
TEST(SmoothingExperiments, TheMissingHalfHalvesTheLimit) {
    Experiment e = experiment_of(ExperimentKind::smoothing);
    e.meshes = {{"bunny", "", "sphere.obj", 1.93e-7, 0, 0}};
    e.operators = {OperatorKind::cotan, OperatorKind::cotan_no_half};
    e.lambda = {1e-7};
    e.iterations = {50, 100};
    const auto done = smoothing_experiment(bundled_meshes, e, {});
    ASSERT_EQ(done.results.size(), 2u);
    EXPECT_EQ(done.results[0].run.lambda, done.results[1].run.lambda);
    EXPECT_NEAR(done.results[0].share(), 1 / 1.93, 1e-9);
    EXPECT_NEAR(done.results[1].share(), 2 / 1.93, 1e-9);
    EXPECT_FALSE(done.results[0].run.result.blew_up);
    EXPECT_EQ(done.results[0].run.snapshots.size(), 2u);
    EXPECT_LE(largest_rise(done.results[0].run.energy), 1e-12) << "within the limit the energy never rises";
    EXPECT_NEAR(top_mode_amplification(smoothing_subject(done.meshes[0].used, OperatorKind::cotan_no_half), done.results[1].run.lambda, 50)
                        .measured /
                    std::pow(2 * done.results[1].share() - 1, 50),
                1, 1e-4);
}

TEST(SmoothingExperiments, TheUsableStepKeepsTheMeshInBounds) {
    const auto source = library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_usable");
    const SmoothingSubject subject = smoothing_subject(source);
    const double few = largest_usable_step(subject, 20), many = largest_usable_step(subject, 200);
    EXPECT_GE(many, subject.critical * (1 - 1e-12));
    EXPECT_GT(few, many) << "more steps need a smaller λ";
    SmoothingOptions options;
    options.iterations = 20;
    options.blow_up_at = 3;
    options.lambda = few;
    EXPECT_FALSE(smooth(source->mesh(), options).blew_up);
    options.lambda = 1.01 * few;
    EXPECT_TRUE(smooth(source->mesh(), options).blew_up);
}

TEST(SmoothingExperiments, ImplicitRunsAreStableAndRebuildingChangesThem) {
    Experiment e = experiment_of(ExperimentKind::smoothing);
    e.methods = {{SmoothingScheme::implicit_euler, false}, {SmoothingScheme::implicit_euler, true}};
    e.lambda = {20};
    e.lambda_unit = StepUnit::tau;
    const auto done = smoothing_experiment(bundled_meshes, e, {});
    ASSERT_EQ(done.results.size(), 2u);
    EXPECT_FALSE(done.results[0].run.result.blew_up);
    EXPECT_LE(largest_rise(done.results[0].run.energy), 1e-12);
    EXPECT_GT(vertex_rms(done.results[0].run.result.X, done.results[1].run.result.X), 1e-6);
}

TEST(NoisyExperiments, NoiseHasTheGivenLevelAndTheMinimumIsFound) {
    Experiment e = experiment_of(ExperimentKind::error_curve);
    e.methods = {{SmoothingScheme::implicit_euler, false}};
    e.lambda = {0.05};
    e.lambda_unit = StepUnit::h2;
    e.noise = {0.1, 0.3};
    e.noise_unit = NoiseUnit::edge;
    e.iterations = {3, 30};
    e.minimum = {0, 4};
    const auto done = noisy_experiment(bundled_meshes, e, {});
    ASSERT_EQ(done.results.size(), 2u);
    for (const NoisyRun& run : done.results) {
        ASSERT_EQ(run.rms.size(), 31u);
        EXPECT_NEAR(run.rms.front() / (std::sqrt(3.0) * run.noise * done.meshes[0].mean_edge), 1, 0.03);
        EXPECT_EQ(run.rms[static_cast<std::size_t>(run.best)], *std::min_element(run.rms.begin(), run.rms.end()));
        EXPECT_NEAR(vertex_rms(done.meshes[0].mesh().X, run.best_X), run.rms[static_cast<std::size_t>(run.best)], 1e-15);
        ASSERT_EQ(run.snapshots.size(), 2u);
        EXPECT_NEAR(vertex_rms(done.meshes[0].mesh().X, run.snapshots[0]), run.rms[3], 1e-15);
        EXPECT_GT(run.gain(), 1.1);
    }
    EXPECT_GT(done.results[1].best, done.results[0].best) << "more noise, later minimum";
    EXPECT_EQ(done.results[1].minimum_said, 4);
}

TEST(NoisyExperiments, WithoutNoiseNothingIsGained) {
    Experiment e = experiment_of(ExperimentKind::denoising);
    e.methods = {{SmoothingScheme::implicit_euler, false}};
    e.noise = {0};
    const auto done = noisy_experiment(bundled_meshes, e, {});
    EXPECT_EQ(done.results.at(0).best, 0);
    EXPECT_EQ(done.results[0].rms.front(), 0);
}

TEST(CurvatureExperiments, CurvatureIsPositiveOnASphere) {
    Experiment e = experiment_of(ExperimentKind::curvature);
    e.colours = {ExperimentColour::h_uniform, ExperimentColour::gauss, ExperimentColour::h_cotan};
    e.operators = {OperatorKind::cotan, OperatorKind::cotan_no_half};
    const auto done = curvature_experiment(bundled_meshes, e, {});
    ASSERT_EQ(done.results.size(), 4u) << "cotangent H for each operator, K and uniform H once";
    const double h = done.meshes[0].mean_edge;
    for (const ExperimentField& field : done.results) {
        EXPECT_EQ(field.positive, 1) << name_of(field.colour);
        EXPECT_TRUE(std::isnan(field.largest_boundary));
    }
    EXPECT_NEAR(done.results[1].summary.median / (h * h), 1, 0.02) << "K = 1";
    EXPECT_NEAR(done.results[2].summary.median / h, 1, 0.02) << "H = 1";
    EXPECT_NEAR(done.results[3].summary.median / done.results[2].summary.median, 2, 1e-9) << "without the half twice as much";
}

TEST(CurvatureExperiments, OnAPlaneOnlyTheBoundaryHasValues) {
    Experiment e = experiment_of(ExperimentKind::curvature);
    e.meshes = {{"plane", "", "plane.obj", 0, 0, 0}};
    e.colours = {ExperimentColour::h_cotan, ExperimentColour::gauss};
    const auto done = curvature_experiment(bundled_meshes, e, {});
    for (const ExperimentField& field : done.results) {
        EXPECT_LT(field.largest_inside, 1e-12);
        EXPECT_GT(field.largest_boundary, 0.1);
        EXPECT_EQ(field.summary.count, 64);
    }
    // At a straight boundary of the unit grid |Cx| = 1, A = ½ and Σθ = π: 32 vertices that are no corners.
    const double h = done.meshes[0].mean_edge;
    EXPECT_EQ((done.results[0].drawn.array() / h - 1).abs().unaryExpr([](double gap) { return gap < 1e-9 ? 1 : 0; }).sum(), 32);
    EXPECT_EQ((done.results[1].drawn.array() / (h * h) - 2 * M_PI).abs().unaryExpr([](double gap) { return gap < 1e-9 ? 1 : 0; }).sum(),
              32);
}

TEST(ColoursOf, AreComputedOnTheMovedMesh) {
    Experiment e = experiment_of(ExperimentKind::smoothing);
    const ExperimentMesh mesh = experiment_meshes(bundled_meshes, e, {}).at(0);
    EXPECT_EQ(colours_of(mesh, ExperimentColour::none, mesh.mesh().X).size(), 0);
    EXPECT_EQ(colours_of(mesh, ExperimentColour::distance, mesh.mesh().X).maxCoeff(), 0);
    const Vector before = colours_of(mesh, ExperimentColour::gauss, mesh.mesh().X);
    const Vector twice = colours_of(mesh, ExperimentColour::gauss, 2 * mesh.mesh().X);
    EXPECT_NEAR((4 * twice - before).cwiseAbs().maxCoeff() / before.maxCoeff(), 0, 1e-12) << "K falls with the square of the size";
}

TEST(ReconstructionExperiments, TheErrorFallsInTheNormOfTheOperatorsMass) {
    Experiment e = experiment_of(ExperimentKind::reconstruction);
    e.operators = {OperatorKind::cotan, OperatorKind::edge_normalised};
    e.k = {4, 9, 30};
    const auto done = reconstruction_experiment(bundled_meshes, e, {});
    ASSERT_EQ(done.results.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_LT(done.results[i].residual, 1e-6);
        if (i % 3 == 0) continue;   // the next operator begins
        EXPECT_LE(done.results[i].mass_rms, done.results[i - 1].mass_rms + 1e-12);
    }
    EXPECT_LT(done.results[0].difference.rms / done.meshes[0].diagonal, 0.01) << "four modes of a sphere are its coordinates";
}

}   // namespace meshfolio::reproductions
