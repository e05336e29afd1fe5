#include <gtest/gtest.h>

#include <cmath>

#include "geometry/spectrum/laplace_spectrum.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/modes/mode_study.h"

namespace meshfolio::modes {
using namespace testing_tools;

namespace {

const ModeStudy& egg_study() {
    static const ModeStudy study = mode_study(library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_modes"), quick_settings());
    return study;
}

const CostModel& egg_model() { return egg_study().model; }

}   // namespace

TEST(ModeStudy, EveryModeFollowsItsLaw) {
    const ModeStudy& study = egg_study();
    EXPECT_TRUE(study.all);
    EXPECT_EQ(study.eigenvalues.size(), study.subject.mesh().vertex_count());
    ASSERT_EQ(study.dampings.size(), 6u);
    for (const ModeDamping& d : study.dampings) {
        for (Eigen::Index i = 0; i < study.eigenvalues.size(); ++i) {
            const double x = d.lambda * study.eigenvalues[i];
            const double law = d.scheme == SmoothingScheme::explicit_euler ? std::pow(1 - x, d.steps) : 1 / std::pow(1 + x, d.steps);
            EXPECT_NEAR(d.measured[i], law, 1e-10 * std::max(1.0, std::abs(law)));
        }
    }
}

TEST(ModeStudy, AWrongStepDeviatesFromTheLaw) {
    ModeDamping damping = egg_study().dampings.front();
    EXPECT_LT(damping.deviation(egg_study().eigenvalues), 1e-10);
    damping.lambda *= 1.001;   // a law of another step
    EXPECT_GT(damping.deviation(egg_study().eigenvalues), 1e-4);
}

TEST(ModeStudy, MeasuresTheLowestModesAndTheTopOfALargerMesh) {
    const ModeStudy study = mode_study(library_mesh(icosphere(4), "ball_modes"), quick_settings());
    EXPECT_FALSE(study.all);
    EXPECT_EQ(study.eigenvalues.size(), 21);
    EXPECT_NEAR(study.eigenvalues.maxCoeff(), study.subject.top.value, 1e-12 * study.subject.top.value);
    for (const ModeDamping& d : study.dampings) EXPECT_LT(d.deviation(study.eigenvalues), 1e-9);
}

TEST(ModeStudy, TheGapIsPredictedAndOfSecondOrder) {
    QuestionSettings settings = quick_settings();
    const double critical = egg_study().subject.critical;
    settings.lambda = {1e-3 * critical, 2e-3 * critical};
    settings.iterations = {10};
    const ModeStudy study = mode_study(library_mesh(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_gap"), settings);
    ASSERT_EQ(study.gaps.size(), 2u);
    for (const SchemeGap& gap : study.gaps) {
        EXPECT_NEAR(gap.predicted / gap.measured, 1, 1e-6);
    }
    EXPECT_NEAR(study.gaps[1].measured / study.gaps[0].measured, 4, 0.1) << "λ²";
    for (const SchemeGap& gap : egg_study().gaps) EXPECT_NEAR(gap.predicted / gap.measured, 1, 1e-6);
}

TEST(CostModel, WaysReachTheirTargets) {
    const CostModel& model = egg_model();
    for (const double energy : {0.9, 0.3, 0.02}) {
        const SmoothingTarget target = smoothing_target(model, energy);
        EXPECT_LE(target.explicit_way.energy, energy);
        EXPECT_GT(target.explicit_way.steps, 0);
        for (std::size_t which = 0; which < std::size(implicit_steps); ++which) {
            EXPECT_NEAR(target.implicit_ways[which].energy / energy, 1, 1e-9);
            EXPECT_EQ(target.implicit_ways[which].steps, implicit_steps[which]);
        }
        EXPECT_NEAR(model.measure.energy([&](double mu) { return std::exp(-model.exact_time(energy) * mu); }) /
                        model.measure.energy([](double) { return 1.0; }),
                    energy, 1e-9);
    }
    EXPECT_EQ(model.explicit_way(0.5).steps, model.explicit_way(0.5 + 1e-12).steps);
}

TEST(CostModel, MoreStepsReduceTheError) {
    const CostModel& model = egg_model();
    double before = INFINITY;
    for (const int steps : {1, 2, 4, 8, 16, 200}) {
        const SmoothingWay way = model.implicit_way(0.1, steps);
        EXPECT_LT(way.error, before);
        before = way.error;
    }
    EXPECT_LT(before, 0.01);
    for (const double error : {0.2, 0.01, 0.001}) {
        const SmoothingWay way = model.implicit_way_within(0.1, error);
        EXPECT_LE(way.error, error);
        if (way.steps > 1) {
            EXPECT_GT(model.implicit_way(0.1, way.steps - 1).error, error);
        }
    }
}

// Compares Gauss quadrature, filters and a root finder with the matrix exponential by all modes.
TEST(CostModel, ErrorEqualsTheDistanceFromTheExactFlow) {
    const ModeStudy& study = egg_study();
    const CostModel& model = egg_model();
    const SmoothingWay way = model.implicit_way(0.2, 3);
    const LaplaceBeltrami& laplacian = study.subject.laplacian;
    SpectrumOptions options;
    options.dense_below = 2000;
    const Spectrum all = smallest_eigenpairs(laplacian, int(laplacian.M.size()), options);
    const Positions& X = study.subject.mesh().X;
    const Positions c = all.eigenvectors.transpose() * (laplacian.M.asDiagonal() * X);
    const double time = model.exact_time(0.2);
    double gap = 0, motion = 0, energy = 0, initial = 0;
    for (Eigen::Index i = 0; i < c.rows(); ++i) {
        const double mu = all.eigenvalues[i], size = c.row(i).squaredNorm(), exact = std::exp(-time * mu);
        gap += size * std::pow(std::pow(1 + way.lambda * mu, -3) - exact, 2);
        motion += size * std::pow(1 - exact, 2);
        energy += size * mu * exact * exact;
        initial += size * mu;
    }
    EXPECT_NEAR(energy / initial, 0.2, 1e-8);
    EXPECT_NEAR(way.error / std::sqrt(gap / motion), 1, 1e-6);
}

TEST(CostModel, OperationsCountFactorisationAndSteps) {
    const CostModel& model = egg_model();
    const SmoothingWay one = model.implicit_way(0.5, 1), three = model.implicit_way(0.5, 3);
    EXPECT_NEAR(three.operations - one.operations, 2 * model.implicit_step, 1e-6);
    EXPECT_NEAR(one.operations - model.implicit_step, model.factor.factorisation, 1e-6);
    const SmoothingWay way = model.explicit_way(0.5);
    EXPECT_NEAR(way.operations, way.steps * 3.0 * double(egg_study().subject.laplacian.C.nonZeros()), 1e-6);
}

TEST(ModeStudy, RunsHaveThePredictedEnergies) {
    ASSERT_FALSE(egg_study().tried.empty());
    for (const TriedWay& run : egg_study().tried) EXPECT_NEAR(run.energy / run.way.energy, 1, 1e-8);
}

TEST(CostModel, FindsTheCrossingFromWhichTheWayStaysCheaper) {
    const auto target = [](double energy, double explicit_operations, double implicit_operations) {
        SmoothingTarget t{energy, {}, {{}}};
        t.explicit_way.steps = t.implicit_ways[0].steps = 1;
        t.explicit_way.operations = explicit_operations;
        t.implicit_ways[0].operations = implicit_operations;
        return t;
    };
    std::vector<SmoothingTarget> curve{target(0.9, 5, 3), target(0.5, 5, 8), target(0.1, 5, 4), target(0.01, 5, 4)};
    EXPECT_EQ(cheaper_from(curve, 0), std::optional<std::size_t>(2));
    curve.back().implicit_ways[0].operations = 6;
    EXPECT_FALSE(cheaper_from(curve, 0).has_value());
    curve.back().explicit_way.steps = 0;   // never gets there
    EXPECT_EQ(cheaper_from(curve, 0), std::optional<std::size_t>(2));
    curve.back().implicit_ways[0].steps = 0;
    EXPECT_FALSE(cheaper_from(curve, 0).has_value());
}

TEST(ModeStudy, CrossingsAreWhereTheCostsMeet) {
    const ModeStudy& study = egg_study();
    const CostModel& model = egg_model();
    int met = 0;
    for (std::size_t which = 0; which < std::size(implicit_steps); ++which) {
        if (!study.crossings[which] || study.crossings[which]->energy >= study.curve.front().energy) continue;
        ++met;
        const SmoothingTarget at = *study.crossings[which], before = smoothing_target(model, 1.02 * at.energy);
        EXPECT_TRUE(is_cheaper(at.implicit_ways[which], at.explicit_way));
        EXPECT_FALSE(is_cheaper(before.implicit_ways[which], before.explicit_way)) << "or a step of the staircase of explicit steps";
    }
    EXPECT_GT(met, 0);
}

// Each further step makes the two results more alike, so the facts name the gap after the first step.
TEST(ModeStudy, TheFactsNameTheGapAfterTheFirstStep) {
    const ModeStudy& study = egg_study();
    ASSERT_EQ(study.gaps.front().steps, 1);
    double largest = 0;
    for (const SchemeGap& gap : study.gaps) largest = std::max(largest, gap.share());
    const report::Facts facts = shape_facts({study});
    EXPECT_EQ(std::get<std::string>(std::ranges::find(facts, "gap", &report::Fact::name)->value), readable_percent(largest, 2));
}

TEST(ModesSection, IsWellFormedAndPassesItsChecks) {
    const Answer answer =
        chapter_of_id("modes").answer(library_of(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_modes_section"), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(ModesSection, AnswersForDegenerateMeshes) {
    TriangleMesh triangle;
    triangle.X.resize(3, 3);
    triangle.X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    triangle.F.resize(1, 3);
    triangle.F << 0, 1, 2;
    for (const TriangleMesh& mesh : {triangle, cube_mesh(1)}) {
        const Answer answer = chapter_of_id("modes").answer(library_of(mesh, "tiny_modes"), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

}   // namespace meshfolio::modes
