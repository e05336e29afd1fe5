#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {
using namespace testing_tools;

TEST(SpectralUseDiscussion, ThinPartsAreExplainedOnlyWhereTheyClearlySufferAtEveryK) {
    const SpectralStudy study = spectral_study_on(ellipsoid_mesh(3, {1.7, 1.1, 0.6}), "egg_text", {5, 15, 30});
    LimbStudy limbs = limb_study(study);
    const auto told = [&](double ratio, double later) {
        limbs.errors[1].thick = limbs.errors[1].thin / ratio;
        limbs.errors[2].thin = later * limbs.errors[2].thick;
        return report::plain(thin_parts(study, limbs));
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    limbs.thin_diameter = wavelength(study, 15) / 4;
    EXPECT_TRUE(has(told(3, 2.9), "At k = 15 the wavelength is 4.0 times the thickness of the thin parts")) << told(3, 2.9);
    EXPECT_TRUE(has(told(3, 2.9), "so they still lag behind")) << told(3, 2.9);
    EXPECT_FALSE(has(told(3, 1.2), "lag behind")) << told(3, 1.2);
    limbs.thin_diameter = wavelength(study, 15) / 3;   // the wave goes once round
    EXPECT_FALSE(has(told(3, 2.9), "the wavelength is")) << "the modes are short enough";
    EXPECT_TRUE(has(told(3, 1.2), "nearly as good as thick ones"));
    EXPECT_TRUE(has(told(1.2, 3), "do not clearly suffer more"));
    limbs.thin_diameter /= 2;
    EXPECT_FALSE(has(told(1.2, 3), "the wavelength is")) << "nothing is to be explained";
    EXPECT_TRUE(thin_parts(study, LimbStudy()).empty());
}

TEST(SpectralUseDiscussion, TheLawSaysHowWellItFitsAndWhereItEnds) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_law", {5, 162});
    const auto said = [&] { return report::plain(how_fast(study)); };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    for (int k = 1; k <= study.modes(); ++k) study.rms[k] = study.diagonal / k;
    EXPECT_NEAR(fall_of_the_error(study)->deviation, 1, 1e-9);
    EXPECT_FALSE(has(said(), "Beyond it falls faster")) << said();
    study.rms[study.modes()] *= 0.1;
    EXPECT_TRUE(has(said(), "at k = 162 nothing is missing")) << said();
    study.rms[20] *= 2;   // the law hardly moves
    EXPECT_NEAR(fall_of_the_error(study)->deviation, 2, 0.1);
}

TEST(SpectralUseDiscussion, SingleVerticesThatGetWorseAreCounted) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_worse", {5, 20});
    std::vector<Reconstruction>& all = study.reconstructions;
    const auto said = [&] { return report::plain(better_or_not(study)); };
    all[1].distance = 0.5 * all[0].distance;
    EXPECT_EQ(share_made_worse(study, all[0], all[1]), 0);
    EXPECT_EQ(said().find("Single vertices may"), std::string::npos);
    all[0].distance.setConstant(1), all[1].distance.setConstant(0.5);
    all[1].distance.head(81).setConstant(2);   // of 162
    EXPECT_EQ(share_made_worse(study, all[0], all[1]), 0.5);
    EXPECT_NE(said().find("Single vertices may: 50\u202f% of them are farther from their places at k = 20 than at k = 5"),
              std::string::npos);
}

// Verdict, then the errors of the k that are drawn; rounding is none of them.
TEST(SpectralUseDiscussion, TheAnswerHasTheErrorsOfTheKAskedFor) {
    const auto said = [](std::vector<int> k) {
        const std::string name = "ball_answer" + std::to_string(k.front());
        return report::plain(answer_in_short({Subject{spectral_study_on(icosphere(2), name, std::move(k)), {}, 0, true}}));
    };
    EXPECT_TRUE(said({2, 5, 162}).starts_with("Yes: for the whole mesh a larger k never does worse. The error of ball_answer2 is "));
    EXPECT_NE(said({2, 5, 162}).find("of the box diagonal at k = 2 and "), std::string::npos) << said({2, 5, 162});
    EXPECT_EQ(said({2, 5, 162}).find("at 162"), std::string::npos);
    EXPECT_NE(said({162}).find("gives ball_answer162 back to rounding"), std::string::npos) << said({162});
}

// Observations about the assignment's armadillo are made of no other mesh.
TEST(SpectralUseDiscussion, PartsOfTheBodyAreThoseOfOneMesh) {
    const SpectralStudy study = spectral_study_on(icosphere(2), "armadillo", {5, 15});
    EXPECT_EQ(report::plain(what_is_seen({study, {}, 0, true})).find("spikes"), std::string::npos);
}

TEST(SpectralUseDiscussion, WhatIsStillSeenIsCalledThinOnlyWhereItIs) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_seen", {5, 60});
    Vector &first = study.reconstructions[0].distance, &last = study.reconstructions[1].distance;
    const auto said = [&](double on_thin) {
        LimbStudy limbs;
        limbs.errors = {{.k = 60, .seen_on_thin = on_thin}};
        return report::plain(what_is_seen({study, limbs, 0, true}));
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    first.setConstant(0.02 * study.diagonal);
    last.setConstant(0.009 * study.diagonal);
    EXPECT_TRUE(has(said(NAN), "at k = 5, 100\u202f% of the area is off by more than 1\u202f%, at k = 60 nothing is")) << said(NAN);
    last[0] = 0.02 * study.diagonal;
    EXPECT_EQ(share_seen(study, study.reconstructions[1]), study.laplacian.M[0] / study.laplacian.M.sum());
    EXPECT_TRUE(has(said(0.7), "70\u202f% of this area is on the thinner half")) << said(0.7);
    EXPECT_FALSE(has(said(0.5), "thinner half")) << "as much as by chance";
    first.setZero();
    EXPECT_FALSE(has(said(0.5), "looks better")) << said(0.5);
}

TEST(SpectralUseDiscussion, ARoughReconstructionIsNotCalledClose) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_rough", {5, 60});
    MeshDifference& d = study.reconstructions[1].difference;
    d.area_weighted_rms = 0.004 * study.diagonal;
    const auto close = [&](double degrees) {
        d.mean_normal_angle = degrees * M_PI / 180;
        return report::plain(what_is_seen({study, {}, 0, true})).find("k = 60 is close to the original") != std::string::npos;
    };
    EXPECT_TRUE(close(4.9));
    EXPECT_FALSE(close(5.1));
}

TEST(SpectralUseDiscussion, TheNamedSolverIsTheOneThatRan) {
    SpectralStudy study = spectral_study_on(icosphere(2), "ball_solver", {5});
    const auto said = [&](bool dense) {
        study.spectrum.dense = dense;
        return report::plain(solvers({Subject{study, {}, 0, true}}));
    };
    EXPECT_EQ(said(true), "On ball_solver a dense solver found all 162 eigenvectors.");
    EXPECT_TRUE(said(false).starts_with("On ball_solver shift-invert Lanczos found the first 5 of 162 eigenvectors. Sylvester"));
}

TEST(SpectralUseDiscussion, LowModesPeakFarOutOnlyWhereTheyDo) {
    const SpectralStudy cigar = spectral_study_on(ellipsoid_mesh(3, {4, 1, 1}), "cigar_modes", {5});
    EXPECT_EQ(drawn_modes(cigar), (std::vector{2, 3, 4, 5}));
    EXPECT_GT(remoteness_of_peak(cigar, 2), 95) << "the first mode runs from tip to tip";
    const SpectralStudy ball = spectral_study_on(icosphere(2), "ball_modes", {20});
    EXPECT_EQ(drawn_modes(ball), (std::vector{2, 3, 4, 5, 10, 15}));
    EXPECT_EQ(remoteness_of_peak(ball, 2), 0) << "all vertices are as far";
    EXPECT_NE(report::plain(what_modes_look_like(ball)).find("long nodal lines"), std::string::npos);
    EXPECT_TRUE(what_modes_look_like(spectral_study_on(ball.mesh(), "ball_one", {1})).empty());
}

}   // namespace meshfolio::q4_spectral
