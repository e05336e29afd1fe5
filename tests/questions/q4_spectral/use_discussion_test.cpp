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
        limbs.errors[1].thin = 0.45 * limbs.thin_diameter;
        limbs.errors[1].thick = limbs.errors[1].thin / ratio;
        limbs.errors[2].thin = later * limbs.errors[2].thick;
        return report::plain(thin_parts(study, limbs));
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    EXPECT_TRUE(has(told(3, 2.9), "Curvature explains it"));
    EXPECT_TRUE(has(told(3, 2.9), "There they have collapsed"));
    EXPECT_FALSE(has(told(3, 1.2), "Curvature explains it")) << "later thin parts are as good";
    EXPECT_TRUE(has(told(3, 1.2), "nearly as good as thick ones"));
    EXPECT_TRUE(has(told(1.2, 3), "do not clearly suffer more"));
    EXPECT_FALSE(has(told(1.2, 3), "explains")) << "nothing is to be explained";
    limbs.errors[1].thin = 0.2 * limbs.thin_diameter;
    limbs.errors[1].thick = limbs.errors[1].thin / 3;
    EXPECT_FALSE(has(report::plain(thin_parts(study, limbs)), "collapsed"));
    EXPECT_TRUE(thin_parts(study, LimbStudy()).empty());
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
