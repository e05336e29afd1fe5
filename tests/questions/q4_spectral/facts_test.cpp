#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/q4_spectral/study.h"

namespace meshfolio::q4_spectral {
using namespace testing_tools;

namespace {

/// Returns the text of a message about one of the meshes, or about a mesh alone.
std::string message(const char* key, const Subjects& subjects, std::size_t which) {
    std::string text;
    for (const report::Block& block : words.blocks(key, facts_of(subjects, which)))
        text += report::plain(std::get<report::Paragraph>(block).text);
    return text;
}
std::string message(const char* key, const Subject& subject) { return message(key, Subjects{subject}, 0); }
std::string message(const char* key, const SpectralStudy& study, const LimbStudy& limbs = {}) {
    return message(key, Subject{study, limbs});
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}   // namespace

TEST(SpectralFacts, ThinPartsAreExplainedOnlyIfTheirErrorIsClearlyLarger) {
    const SpectralStudy study = spectral_study_on(ellipsoid_mesh(3, {1.7, 1.1, 0.6}), "egg_text", {5, 15, 30});
    LimbStudy limbs = limb_study(study);
    const auto said = [&](double ratio) {
        limbs.errors[1].thick = limbs.errors[1].thin / ratio;
        return message("thin", study, limbs);
    };
    limbs.thin_diameter = wavelength(study, 15) / 4;
    EXPECT_TRUE(has(said(3), "err more on egg_text. The thickness at a vertex is the diameter")) << said(3);
    EXPECT_TRUE(has(said(3), "At k = 15 even the shortest wave is 4.0 times the thickness of the thin parts")) << said(3);
    EXPECT_TRUE(has(said(1.2), "do not clearly err more")) << said(1.2);
    EXPECT_FALSE(has(said(1.2), "the shortest wave is")) << "nothing is to be explained";
    limbs.thin_diameter = wavelength(study, 15) / 3;   // the wave goes once round
    EXPECT_FALSE(has(said(3), "the shortest wave is")) << "the modes are short enough";
    EXPECT_EQ(message("thin", study), "");
}

TEST(SpectralFacts, ThicknessIsDefinedOnce) {
    const SpectralStudy egg = spectral_study_on(ellipsoid_mesh(3, {1.7, 1.1, 0.6}), "egg_once", {5, 15}),
                        sheet = spectral_study_on(grid_mesh(12, 12, 1, 1), "sheet_once", {5, 15});
    const Subjects subjects{{sheet, limb_study(sheet)}, {egg, limb_study(egg)}, {egg, limb_study(egg)}};
    const auto defined = [&](std::size_t which) { return has(message("thin", subjects, which), "The thickness at a vertex is"); };
    EXPECT_FALSE(defined(0)) << "an open mesh has none";
    EXPECT_TRUE(defined(1));
    EXPECT_FALSE(defined(2));
}

TEST(SpectralFacts, TheTextNamesTheFitOfThePowerLawAndItsEnd) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_law", {5, 162});
    for (int k = 1; k <= study.modes(); ++k) study.rms[k] = study.diagonal / k;
    EXPECT_NEAR(fall_of_the_error(study)->deviation, 1, 1e-9);
    EXPECT_TRUE(has(message("rate", study), "to the power −1.0")) << message("rate", study);
    EXPECT_TRUE(has(message("lead", study), "takes 2.0 times as many modes")) << message("lead", study);
    EXPECT_FALSE(has(message("rate", study), "Beyond it falls faster"));
    study.rms[study.modes()] *= 0.1;
    EXPECT_TRUE(has(message("rate", study), "at k = 162 nothing is missing")) << message("rate", study);
    study.rms[20] *= 2;   // the law hardly moves
    EXPECT_NEAR(fall_of_the_error(study)->deviation, 2, 0.1);
    EXPECT_EQ(message("rate", study), "") << "no law";
}

TEST(SpectralFacts, VerticesThatMoveAwayAreCounted) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_worse", {5, 20});
    std::vector<Reconstruction>& all = study.reconstructions;
    all[1].distance = 0.5 * all[0].distance;
    EXPECT_EQ(share_made_worse(study, all[0], all[1]), 0);
    EXPECT_FALSE(has(message("better", study), "Single vertices"));
    all[0].distance.setConstant(1), all[1].distance.setConstant(0.5);
    all[1].distance.head(81).setConstant(2);   // of 162
    EXPECT_EQ(share_made_worse(study, all[0], all[1]), 0.5);
    EXPECT_TRUE(has(message("better", study), "50\u202f% move away from their places between k = 5 and k = 20"))
        << message("better", study);
}

// The answer has the errors of the first and of the largest k that are not rounding.
TEST(SpectralFacts, TheAnswerHasTheErrorsOfTheKAskedFor) {
    const auto said = [](std::vector<int> k) {
        const std::string name = "ball_answer" + std::to_string(k.front());
        const Subject subject{spectral_study_on(icosphere(2), name, std::move(k)), {}};
        return report::plain(words.say("answer", facts_of({subject}, 0)));
    };
    EXPECT_TRUE(said({2, 5, 162}).starts_with("Yes: with k the error of ball_answer2 never rises: ")) << said({2, 5, 162});
    EXPECT_TRUE(has(said({2, 5, 162}), "of the box at k = 2, ")) << said({2, 5, 162});
    EXPECT_FALSE(has(said({2, 5, 162}), "at 162"));
    EXPECT_TRUE(said({5}).ends_with("of the box at k = 5.")) << said({5});
    EXPECT_TRUE(has(said({162}), "k = 162 gives the mesh back")) << said({162});
}

// Another mesh of the name armadillo gets no sentence about body parts.
TEST(SpectralFacts, BodyPartsAreMentionedForOneMeshOnly) {
    EXPECT_FALSE(has(message("pictures", spectral_study_on(icosphere(2), "armadillo", {5, 15})), "spikes"));
}

TEST(SpectralFacts, TheVisibleErrorIsCalledThinOnlyIfItIsOnThinParts) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_seen", {5, 60});
    Vector &first = study.reconstructions[0].distance, &last = study.reconstructions[1].distance;
    const auto remains = [&](double on_thin) {
        return message("thin", study, LimbStudy{1, 1, {{.k = 60, .thin = 1, .thick = 1, .seen_on_thin = on_thin}}});
    };
    EXPECT_TRUE(has(remains(0.7), "sits on the thin parts: 70\u202f% of the area off by more than 1\u202f%")) << remains(0.7);
    EXPECT_FALSE(has(remains(0.5), "sits on the thin parts")) << "as much as by chance";
    EXPECT_FALSE(has(remains(NAN), "sits on the thin parts")) << "nothing is seen";
    first.setConstant(0.02 * study.diagonal);
    last.setConstant(0.009 * study.diagonal);
    last[0] = 0.02 * study.diagonal;
    EXPECT_EQ(share_seen(study, study.reconstructions[1]), study.laplacian.M[0] / study.laplacian.M.sum());
    EXPECT_TRUE(has(message("pictures", study), "shrinks from 100\u202f% to 0.")) << message("pictures", study);
    first.setZero();
    EXPECT_FALSE(has(message("pictures", study), "shrinks"));
}

TEST(SpectralFacts, TheNamedSolverIsTheOneThatRan) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_solver", {5});
    study.spectrum.dense = true;
    EXPECT_EQ(message("solvers", study), "On ball_solver a dense solver found all 162 eigenvectors.");
    study.spectrum.dense = false;
    EXPECT_TRUE(
        message("solvers", study).starts_with("On ball_solver shift-invert Lanczos found the first 5 of 162 eigenvectors. Sylvester"));
}

TEST(SpectralFacts, TheModesDrawnAreTheFirstAndTheLastOfEachK) {
    EXPECT_EQ(drawn_modes(spectral_study_on(icosphere(2), "ball_modes", {20})), (std::vector{2, 5, 15}));
    EXPECT_EQ(drawn_modes(spectral_study_on(icosphere(2), "ball_modes", {60})), (std::vector{2, 5, 15, 60}));
    EXPECT_EQ(message("modes", spectral_study_on(icosphere(2), "ball_one", {1})), "");
}

// The unit sphere has l(l + 1) for (l + 1)² modes, so μ ≈ k; a unit square with a free boundary has π²(a² + b²).
TEST(SpectralFacts, EigenvaluesFollowWeylsLawWithAndWithoutABoundary) {
    EXPECT_NEAR(weyl_eigenvalue(7, 4 * M_PI, 0), 7, 1e-12);
    EXPECT_LT(distance_from_weyl(spectral_study_on(icosphere(4), "ball_weyl", {150})), 0.2);
    const SpectralStudy sheet = spectral_study_on(grid_mesh(40, 40, 1, 1), "sheet_weyl", {150});
    EXPECT_LT(distance_from_weyl(sheet), 0.1);
    for (const int k : {50, 100, 150})
        EXPECT_GT(4 * M_PI * k, 1.1 * sheet.spectrum.eigenvalues[k - 1]) << "without the boundary the law is too high";
    EXPECT_TRUE(std::isnan(distance_from_weyl(spectral_study_on(cube_mesh(1), "cube_weyl", {8})))) << "nothing is resolved";
}

}   // namespace meshfolio::q4_spectral
