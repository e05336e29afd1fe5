#include "questions/bench/spectral_uses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

TriangleMesh egg() { return ellipsoid_mesh(3, {1.7, 1.1, 0.6}); }

}   // namespace

TEST(MistakeStudy, TheRightWayIsThatOfTheReconstructions) {
    const SpectralStudy study = spectral_study_on(egg(), "egg_mistakes", {5, 15, 30});
    const std::vector<MistakeErrors> mistakes = mistake_study(study, true);
    for (const Reconstruction& r : study.reconstructions) {
        const auto at = std::ranges::find(mistakes, r.k, &MistakeErrors::k);
        ASSERT_NE(at, mistakes.end());
        EXPECT_NEAR(at->right, r.difference.rms, 1e-12);
        EXPECT_GT(at->unmapped, at->right);
        EXPECT_GT(at->unweighted, 10 * at->right);
    }
}

// A dumbbell's thin parts lose their girth first.
TEST(LimbStudy, ThinTubesNeedTheModesThatGoRoundThem) {
    TriangleMesh mesh = torus_mesh(96, 24, 1, 0.1);
    const SpectralStudy study = spectral_study_on(mesh, "ring_limbs", {5, 40});
    const LimbStudy limbs = limb_study(study);
    ASSERT_TRUE(limbs.measured());
    EXPECT_NEAR(limbs.thin_diameter, 0.2, 0.01);
    EXPECT_NEAR(limbs.thick_diameter, 0.2, 0.01);
    EXPECT_GT(limbs.errors.front().thin, 0.5 * 0.1) << "at k = 5 the ring is its own axis";
    EXPECT_LT(limbs.errors.back().thin, 0.02) << "at k = 40 it has its girth";
}

TEST(LimbStudy, SharesOfPlantedErrors) {
    SpectralStudy study = spectral_study_on(ellipsoid_mesh(3, {3, 1, 1}), "cigar_limbs", {5});
    Reconstruction& r = study.reconstructions.front();
    const Vector along = study.mesh().X.col(0).cwiseAbs();
    r.distance = (along.array() > 2.5).select(Vector::Ones(along.size()), 0);   // only the tips
    LimbStudy limbs = limb_study(study);
    EXPECT_GT(limbs.thick_diameter, 1.9);
    EXPECT_LT(limbs.thin_diameter, 1.6);
    EXPECT_EQ(limbs.errors.front().thick, 0);
    EXPECT_GT(limbs.errors.front().thin, 0.3);
    EXPECT_GT(limbs.errors.front().seen_on_thin, 0.9);
    r.distance.setOnes();
    EXPECT_NEAR(limb_study(study).errors.front().seen_on_thin, 0.5, 0.02);
    r.distance.setConstant(0.9 * seen_error * study.diagonal);
    EXPECT_TRUE(std::isnan(limb_study(study).errors.front().seen_on_thin)) << "nothing is seen";
}

TEST(LimbStudy, AnOpenSurfaceHasNone) { EXPECT_FALSE(limb_study(spectral_study_on(grid_mesh(12, 12, 1, 1), "sheet", {5})).measured()); }
