#include "questions/bench/spectral_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

TEST(SpectralStudy, RebuildsOncePerKInAscendingOrder) {
    const SpectralStudy study = spectral_study_on(cube_mesh(4), "cube_k", {12, 5, 12, 100000, 5});
    ASSERT_EQ(study.reconstructions.size(), 3u);
    EXPECT_EQ(study.reconstructions[0].k, 5);
    EXPECT_EQ(study.reconstructions[1].k, 12);
    EXPECT_EQ(study.reconstructions[2].k, study.vertices());
    EXPECT_EQ(study.modes(), study.vertices());
    EXPECT_EQ(study.rms.size(), study.modes() + 1);
}

TEST(SpectralStudy, DistancesAgreeWithCompareMeshes) {
    const SpectralStudy study = spectral_study_on(ellipsoid_mesh(2, {1.7, 1.1, 0.6}), "egg_distance", {4, 30});
    for (const Reconstruction& r : study.reconstructions) {
        EXPECT_NEAR(r.distance.maxCoeff(), r.difference.max, 1e-12);
        EXPECT_NEAR(std::sqrt(r.distance.squaredNorm() / study.mesh().vertex_count()), r.difference.rms, 1e-12);
        EXPECT_NEAR(r.predicted_rms, r.difference.area_weighted_rms, 1e-12);
        EXPECT_GT(r.difference.volume_ratio, 0);
        EXPECT_LT(r.difference.volume_ratio, 1);   // of a convex body, whose detail is cut off
    }
    EXPECT_LT(largest_parseval_gap(study), 1e-12);
}

TEST(SpectralStudy, FindsTheLargestParsevalGap) {
    SpectralStudy study;
    study.reconstructions.resize(3);
    study.reconstructions[0].predicted_rms = 1;
    study.reconstructions[0].difference.area_weighted_rms = 1.5;
    study.reconstructions[2].predicted_rms = 0.25;
    EXPECT_EQ(largest_parseval_gap(study), 0.5);
}

TEST(SpectralStudy, FindsTheSmallestKBelowAnError) {
    const SpectralStudy study = spectral_study_on(torus_mesh(16, 8, 1, 0.4), "torus_smallest", {60});
    for (const double share : {0.3, 0.1, 0.05}) {
        const int k = smallest_k_below(study, share);
        ASSERT_GT(k, 0);
        EXPECT_LE(study.rms[k], share * study.diagonal);
        if (k > 1) {
            EXPECT_GT(study.rms[k - 1], share * study.diagonal);
        }
    }
    EXPECT_EQ(smallest_k_below(study, 1e-30), 0);
    EXPECT_EQ(smallest_k_below(study, 1), 1);
}

TEST(SpectralStudy, FindsThePowerOfAKnownLaw) {
    SpectralStudy study;
    study.rms = Vector(65);
    for (int k = 0; k < 65; ++k) study.rms[k] = 3 * std::pow(k + 1e-300, -1.5);
    for (const PowerLaw& law : {power_law(study, 2, 64), power_law(study, 8, 9)}) {
        EXPECT_NEAR(law.power, 1.5, 1e-12);
        EXPECT_NEAR(law.factor, 3, 1e-10);
        EXPECT_NEAR(law.at(16), study.rms[16], 1e-12);
    }
    study.rms[64] *= 3;   // one end point off: the fit over all k hardly notices
    EXPECT_NEAR(power_law(study, 2, 64).power, 1.5, 0.1);
}

TEST(SpectralStudy, FitsTheLawOnlyAboveRounding) {
    const SpectralStudy all = spectral_study_on(torus_mesh(16, 8, 1, 0.4), "torus_fall", {5, 128});
    const auto law = fall_of_the_error(all);
    ASSERT_TRUE(law);
    EXPECT_EQ(law->first, 5);
    EXPECT_LE(law->last, 64) << "behind the last of all modes nothing is left";
    EXPECT_GT(all.rms[law->last], 1e-9 * all.diagonal);
    EXPECT_FALSE(fall_of_the_error(spectral_study_on(cube_mesh(1), "cube_fall", {3, 8})));
}

TEST(SpectralStudy, WavelengthsOfTheSphere) {
    const SpectralStudy study = spectral_study_on(icosphere(3), "ball_wavelengths", {9});
    EXPECT_EQ(zero_modes(study), 1);
    EXPECT_TRUE(std::isinf(wavelength(study, 1)));
    EXPECT_NEAR(wavelength(study, 2), 2 * M_PI / std::sqrt(2), 0.02);   // μ = l(l + 1)
    EXPECT_NEAR(wavelength(study, 9), 2 * M_PI / std::sqrt(6), 0.02);
}

// A ring loses its girth with too few modes.
TEST(LimbStudy, ThinTubesNeedTheModesAroundThem) {
    TriangleMesh mesh = torus_mesh(96, 24, 1, 0.1);
    const SpectralStudy study = spectral_study_on(mesh, "ring_limbs", {5, 40});
    const LimbStudy limbs = limb_study(study);
    ASSERT_TRUE(limbs.measured());
    EXPECT_NEAR(limbs.thin_diameter, 0.2, 0.01);
    EXPECT_NEAR(limbs.thick_diameter, 0.2, 0.01);
    EXPECT_GT(limbs.errors.front().thin, 0.5 * 0.1) << "at k = 5 the ring is its own axis";
    EXPECT_LT(limbs.errors.back().thin, 0.02) << "at k = 40 it has its girth";
}

TEST(LimbStudy, FindsPlantedErrors) {
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

TEST(LimbStudy, OpenSurfacesAreNotMeasured) {
    EXPECT_FALSE(limb_study(spectral_study_on(grid_mesh(12, 12, 1, 1), "sheet", {5})).measured());
}
