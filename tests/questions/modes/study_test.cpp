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
