#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/core/study_laws.h"
#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {
using namespace testing_tools;

namespace {

TriangleMesh lopsided_ball(int level) {
    TriangleMesh mesh = icosphere(level);
    mesh.X.col(0) *= 1.6;
    mesh.X.col(2) += 0.2 * mesh.X.col(0).cwiseAbs2();
    return mesh;
}

PredictionStudy prediction_study_on(const TriangleMesh& mesh, const std::string& name, std::vector<double> noise) {
    QuestionSettings settings = quick_settings();
    settings.noise = std::move(noise);
    return prediction_study(library_mesh(mesh, name), settings);
}

MeasuredCurve curve_of(std::initializer_list<double> squares) {
    std::vector<RunErrors> runs;
    for (const double square : squares) runs.push_back({Vector::Constant(2, square), Vector::Constant(2, 2 * square), Vector::Zero(2)});
    return measured_curve(runs);
}

}   // namespace

TEST(PredictionRuns, StepsAgreeWithImplicitStep) {
    const TriangleMesh mesh = lopsided_ball(2);
    const DenoisingFlow flow(mesh, 0.01);
    const Positions Y = with_gaussian_noise(mesh.X, Vector3::Constant(0.03), 9);
    FlowSolvers solvers;
    const Trajectory clean = denoising_run(flow, FlowOperator::clean, Y, 3, solvers);
    ASSERT_EQ(clean.size(), 4u);
    EXPECT_EQ(clean[0], Y);
    EXPECT_LT((clean[2] - implicit_step(laplace_beltrami(mesh), 0.01, clean[1])).norm(), 1e-11);
    const Trajectory noisy = denoising_run(flow, FlowOperator::noisy, Y, 3, solvers);
    EXPECT_LT((noisy[2] - implicit_step(laplace_beltrami(moved_to(mesh, Y)), 0.01, noisy[1])).norm(), 1e-11);
}

TEST(PredictionRuns, ErrorsAgreeWithCompareMeshes) {
    const TriangleMesh mesh = icosphere(2);
    const DenoisingFlow flow(mesh, 0.01);
    const Positions out = mesh.X * 1.01, Y = with_gaussian_noise(mesh.X, Vector3::Constant(0.1), 3);
    const RunErrors errors = errors_of_run(flow, {mesh.X, out, Y});
    EXPECT_EQ(errors.vertices[0], 0);
    EXPECT_NEAR(errors.vertices[1], 1e-4, 1e-12);
    EXPECT_NEAR(errors.mass[1], 1e-4, 1e-12);
    EXPECT_LT(errors.tangential[1], 1e-6) << "outwards is along no surface";
    EXPECT_NEAR(std::sqrt(errors.vertices[2]), vertex_rms(mesh.X, Y), 1e-15);
    EXPECT_NEAR(errors.mass[2], std::pow(compare_meshes(mesh, moved_to(mesh, Y)).area_weighted_rms, 2), 1e-12);
    EXPECT_NEAR(errors.tangential[2] / errors.vertices[2], 2.0 / 3, 0.07);
}

// A flat mesh is a fixed point of its own operator inside, wherever its vertices lie, so noise along it stays.
TEST(PredictionRuns, TheOwnOperatorKeepsNoiseAlongAPlane) {
    const TriangleMesh plane = grid_mesh(21, 21, 1, 1);
    const DenoisingFlow flow(plane, 1e-4);
    Positions Y = plane.X;
    NormalNumbers random(4);
    for (Eigen::Index v = 0; v < Y.rows(); ++v) {
        for (int c = 0; c < 2; ++c) Y(v, c) += 0.005 * random.next();
    }
    FlowSolvers solvers;
    const Trajectory own = denoising_run(flow, FlowOperator::noisy, Y, 1, solvers),
                     clean = denoising_run(flow, FlowOperator::clean, Y, 1, solvers);
    double own_moved = 0, clean_moved = 0;
    for (int i = 8; i < 13; ++i) {
        for (int j = 8; j < 13; ++j) {
            own_moved = std::max(own_moved, (own[1] - Y).row(21 * i + j).norm());
            clean_moved = std::max(clean_moved, (clean[1] - Y).row(21 * i + j).norm());
        }
    }
    EXPECT_LT(own_moved, 1e-3 * clean_moved);
    EXPECT_GT(clean_moved, 1e-4);
}

TEST(MeasuredCurve, MeanErrorAndPercentiles) {
    const MeasuredCurve curve = curve_of({1, 4, 9, 16, 25});
    EXPECT_EQ(curve.seeds, 5);
    EXPECT_NEAR(curve.square[0], 11, 1e-14);
    EXPECT_NEAR(curve.square_error[1], std::sqrt((100 + 49 + 4 + 25 + 196) / 20.0), 1e-12);
    EXPECT_NEAR(curve.mass[1], 22, 1e-14);
    EXPECT_NEAR(curve.low[0], 1.4, 1e-12);
    EXPECT_NEAR(curve.high[0], 4.6, 1e-12);
    EXPECT_EQ(curve_of({2}).square_error[0], 0);
    EXPECT_THROW(measured_curve({}), MeshError);
}

TEST(PredictionStudy, TheFormulaAgreesWithTheMeanUnlessSigmaIsWrong) {
    for (const TriangleMesh& mesh : {lopsided_ball(2), lopsided_ball(3)}) {   // 162 vertices: modes; 642: probes in the quick report
        const PredictionStudy study = prediction_study_on(mesh, "expected", {0.005, 0.02});
        EXPECT_EQ(study.prediction.modes > 0, mesh.vertex_count() < 300);
        ASSERT_EQ(study.levels.size(), 2u);
        for (const NoiseLevelStudy& level : study.levels) {
            const StandardDistance right = standard_distance(study, level);
            EXPECT_LT(right.vertices, 4);
            EXPECT_LT(right.mass, 4);
            EXPECT_GT(standard_distance(study, level, 1.3).vertices, 5);
            EXPECT_GT(standard_distance(study, level, 0.7).mass, 5);
            EXPECT_EQ(level.of(FlowOperator::clean).measured.seeds, 20);
        }
    }
}

TEST(PredictionStudy, SteinPredictsTheErrorOfTheOwnOperator) {
    const PredictionStudy study = prediction_study_on(lopsided_ball(3), "stein", {0.02});
    const OperatorStudy& own = study.levels.front().of(FlowOperator::noisy);
    EXPECT_LT(deviation(*own.prediction(by_stein), own.measured), 0.05);
    EXPECT_GT(deviation(own.formula(), own.measured), 0.1);
    EXPECT_LT(own.rule(by_stein_estimated)->mean_regret, 0.05);
    for (const RuleOutcome& rule : own.rules) {
        EXPECT_GE(rule.mean_regret, 0);
        EXPECT_GE(rule.worst_regret, rule.mean_regret);
    }
    EXPECT_EQ(own.prediction("no such"), nullptr);
    EXPECT_EQ(own.rule("no such"), nullptr);
    EXPECT_EQ(study.levels.front().of(FlowOperator::clean).rules.size(), 0u);
    EXPECT_NEAR(study.levels.front().sigma_ratio, 1, 0.1);
}

TEST(PredictionStudy, TheDiscrepancyPrincipleStopsLate) {
    QuestionSettings settings = quick_settings();
    settings.noise = {0.008};
    settings.iterations = {60};
    const PredictionStudy study = prediction_study(library_mesh(lopsided_ball(3), "late"), settings);
    const OperatorStudy& own = study.levels.front().of(FlowOperator::noisy);
    ASSERT_TRUE(own.minimum_reached());
    EXPECT_GT(own.rule(by_discrepancy)->mean_chosen, 1.5 * own.measured.best());
    EXPECT_GT(own.rule(by_discrepancy)->mean_regret, own.rule(by_stein_estimated)->mean_regret);
}

TEST(PredictionStudy, TheAccountAddsUp) {
    const PredictionStudy study = prediction_study_on(lopsided_ball(2), "account", {0.01, 0.03});
    for (const NoiseLevelStudy& level : study.levels) {
        const ErrorAccount account = error_account(level);
        EXPECT_NEAR(account.formula + account.numbers + account.knowledge, account.measured, 1e-12);
        EXPECT_GT(account.along_own, account.along_clean) << "the own operator leaves the noise along the surface";
        EXPECT_GT(level.facts.area, 1) << "noise roughens";
    }
    EXPECT_GT(study.levels[1].facts.area, study.levels[0].facts.area);
}

// Scaling the shared spectrum to box diagonals gives the same prediction as an operator in box diagonals.
TEST(PredictionStudy, TheSharedSpectrumPredictsTheScaledMesh) {
    const PredictionStudy study = prediction_study_on(lopsided_ball(2), "scaled", {0.01});
    ASSERT_GT(study.prediction.modes, 0);
    const TriangleMesh& mesh = study.mesh();
    const LaplaceBeltrami scaled = laplace_beltrami(moved_to(mesh, mesh.X / study.diagonal));
    const DenoisingPrediction direct = denoising_prediction(scaled, mesh.X / study.diagonal, {study.lambda, 10});
    for (const auto norm : {&DenoisingPrediction::mass, &DenoisingPrediction::vertices}) {
        const Vector a = (study.prediction.*norm).squared(0.01), b = (direct.*norm).squared(0.01);
        EXPECT_LT((a - b).norm(), 1e-9 * b.norm());
    }
}

TEST(PredictionStudy, DoesNotDependOnTheUnitOfTheModel) {
    const TriangleMesh mesh = lopsided_ball(2);
    const PredictionStudy a = prediction_study_on(mesh, "unit", {0.01}),
                          b = prediction_study_on({1024 * mesh.X, mesh.F}, "unit_large", {0.01});
    const Vector &x = a.levels[0].of(FlowOperator::noisy).measured.square, &y = b.levels[0].of(FlowOperator::noisy).measured.square;
    EXPECT_LT((x - y).norm(), 1e-9 * x.norm());
    EXPECT_NEAR(b.diagonal / a.diagonal, 1024, 1e-6);
    EXPECT_NEAR(a.lambda, b.lambda, 1e-12);
}

TEST(PredictionStudy, ThreadsDoNotChangeABit) {
    const TriangleMesh mesh = lopsided_ball(2);
    const PredictionStudy many = prediction_study_on(mesh, "threads", {0.01});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const PredictionStudy alone = prediction_study_on(mesh, "threads", {0.01});
    for (const FlowOperator kind : {FlowOperator::clean, FlowOperator::noisy}) {
        const OperatorStudy &a = many.levels[0].of(kind), &b = alone.levels[0].of(kind);
        EXPECT_EQ(a.measured.square, b.measured.square);
        for (std::size_t p = 0; p < a.predictions.size(); ++p) EXPECT_EQ(a.predictions[p].square, b.predictions[p].square);
    }
}

TEST(NoiseSection, IsWellFormedOnSmallAndOddMeshes) {
    TriangleMesh one{Positions(3, 3), Faces(1, 3)};
    one.X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    one.F << 0, 1, 2;
    for (const auto& [mesh, name] : {std::pair{one, std::string("alone")}, std::pair{cube_mesh(1), std::string("eight")},
                                     std::pair{grid_mesh(5, 4, 1, 1), std::string("open")},
                                     std::pair{TriangleMesh{1e90 * icosphere(1).X, icosphere(1).F}, std::string("huge")}}) {
        SCOPED_TRACE(name);
        const Answer answer = chapter_of_id("modes").answer(library_of(mesh, name), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
    const std::string prose = prose_of(chapter_of_id("modes").answer(library_of(one, "alone"), quick_settings(), no_progress).section);
    EXPECT_NE(prose.find("σ cannot be estimated"), std::string::npos);
}

TEST(NoiseSection, TablesShowTheStudy) {
    QuestionSettings settings = quick_settings();
    settings.noise = {0.01};
    const auto source = library_mesh(lopsided_ball(2), "shown");
    const PredictionStudy study = prediction_study(source, settings);
    const report::Table clean = expected_table({study}), rule = rule_table({study});
    const OperatorStudy& operated = study.levels[0].of(FlowOperator::clean);
    EXPECT_EQ(std::get<std::string>(cells(clean, "best iteration, expected")[0]).substr(0, 1),
              std::to_string(operated.formula().best()).substr(0, 1));
    expect_near(numbers(clean, "farthest, vertices"), {100 * deviation(operated.formula(), operated.measured)});
    EXPECT_EQ(rule.rows.size(), 1u);
    expect_near({std::get<double>(cells(rule, "regret")[0])},
                {100 * study.levels[0].of(FlowOperator::noisy).rule(by_stein_estimated)->mean_regret});
}

}   // namespace meshfolio::modes
