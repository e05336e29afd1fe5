#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {
using namespace testing_tools;

TEST(SpectralUseDiscussion, TheTextFollowsTheData) {
    const SpectralStudy study = spectral_study_on(ellipsoid_mesh(3, {1.7, 1.1, 0.6}), "egg_text", {5, 30});
    LimbStudy limbs = limb_study(study);
    limbs.errors[1] = {30, 0.3, 0.1, 0.5, -1};
    limbs.modes_needed = 0;
    EXPECT_NE(report::plain(thin_parts(study, limbs)).find("collapse to lines, with 3.0 times"), std::string::npos);
    limbs.errors[1].thin = 0.05;
    EXPECT_EQ(report::plain(thin_parts(study, limbs)).find("collapse"), std::string::npos);
    limbs.errors[1].thin = 0.3;
    limbs.modes_needed = 7;
    EXPECT_NE(report::plain(thin_parts(study, limbs)).find("such modes are in use"), std::string::npos);
    EXPECT_TRUE(thin_parts(study, LimbStudy()).empty());
    EXPECT_TRUE(what_bands_do(study, BandStudy()).empty());
    EXPECT_TRUE(low_pass_without_modes(study, SpectralUses()).empty());
    EXPECT_TRUE(cost_of_mistakes(study, MistakeStudy()).empty());
}

}   // namespace meshfolio::q4_spectral
