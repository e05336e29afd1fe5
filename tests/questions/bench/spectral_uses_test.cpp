#include "questions/bench/spectral_uses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/measures/mesh_error.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

TriangleMesh egg() { return ellipsoid_mesh(3, {1.7, 1.1, 0.6}); }

}   // namespace

TEST(BandStudy, BandsPartAllModesButTheZeroOnes) {
    const SpectralStudy study = spectral_study_on(egg(), "egg_bands", {60});
    const BandStudy bands = band_study(study);
    ASSERT_EQ(bands.bands.size(), 3u);
    EXPECT_EQ(bands.bands[0].first, 2);
    EXPECT_EQ(bands.bands[1].first, bands.bands[0].last + 1);
    EXPECT_EQ(bands.bands[2].first, bands.bands[1].last + 1);
    EXPECT_EQ(bands.bands[2].last, 60);
    double sum = 0;
    for (const Band& band : bands.bands) sum += band.energy_share;
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_GT(bands.bands[0].energy_share, 0.9) << "the coordinates of an egg are nearly its first three modes";
}

TEST(BandStudy, MeshesMoveAsPredicted) {
    const SpectralStudy study = spectral_study_on(egg(), "egg_filters", {60});
    const BandStudy bands = band_study(study);
    ASSERT_EQ(bands.meshes.size(), 5u);
    for (const EqualisedMesh& state : bands.meshes) {
        EXPECT_NEAR(state.predicted_rms, state.measured_rms, 1e-12) << state.label;
        EXPECT_NEAR(state.measured_rms, compare_meshes(study.mesh(), state.mesh).area_weighted_rms, 1e-12) << state.label;
        EXPECT_GT(state.measured_rms, 0) << state.label;
    }
    // gain − 1 is 0.5 on the low band, which holds almost everything, and 1 where the middle one is doubled or removed.
    EXPECT_NEAR(bands.meshes[1].measured_rms, bands.meshes[3].measured_rms, 1e-12);
    EXPECT_GT(bands.meshes[0].measured_rms, bands.meshes[1].measured_rms);
    const int kept = bands.bands[1].last;
    EXPECT_NEAR(bands.meshes[4].measured_rms, study.rms[kept], 1e-12);
}

TEST(BandStudy, TooFewModesHaveNoBands) { EXPECT_TRUE(band_study(spectral_study_on(egg(), "egg_few", {9})).bands.empty()); }

TEST(LowPassStudy, ErrorsAreThoseOfTheKnownModesWhenAllAreKnown) {
    const SpectralStudy study = spectral_study_on(torus_mesh(24, 12, 1, 0.4), "torus_low_pass", {288});
    const LowPassStudy low_pass = low_pass_study(study, true);
    ASSERT_GE(low_pass.k, 10);
    ASSERT_LE(low_pass.k, 20);
    EXPECT_GT(low_pass.cutoff, study.spectrum.eigenvalues[low_pass.k - 1]);
    EXPECT_LT(low_pass.cutoff, study.spectrum.eigenvalues[low_pass.k]);
    EXPECT_GE(low_pass.bound, study.spectrum.eigenvalues[287]);
    EXPECT_LT(low_pass.unknown, 1e-12);
    for (const LowPassError& row : low_pass.errors) EXPECT_NEAR(row.ideal, row.ideal_from_response, 1e-10) << row.degree;
    EXPECT_LT(low_pass.errors.back().smooth, 1e-9);
    EXPECT_LT(low_pass.errors.back().ideal, 0.5 * low_pass.errors.front().ideal);
    EXPECT_NEAR(low_pass.errors.back().operations / low_pass.errors.front().operations,
                double(low_pass.errors.back().degree) / low_pass.errors.front().degree, 1e-12);
}

TEST(LowPassStudy, NeedsACutoff) { EXPECT_EQ(low_pass_study(spectral_study_on(egg(), "egg_no_cutoff", {9}), true).k, 0); }

TEST(MistakeStudy, TheRightWayIsThatOfTheReconstructions) {
    const SpectralStudy study = spectral_study_on(egg(), "egg_mistakes", {5, 15, 30});
    const MistakeStudy mistakes = mistake_study(study, true);
    for (const Reconstruction& r : study.reconstructions) {
        const auto at =
            std::find_if(mistakes.errors.begin(), mistakes.errors.end(), [&](const MistakeErrors& row) { return row.k == r.k; });
        ASSERT_NE(at, mistakes.errors.end());
        EXPECT_NEAR(at->right, r.difference.rms, 1e-12);
        EXPECT_GT(at->unmapped, at->right);
        EXPECT_GT(at->unweighted, 10 * at->right);
    }
    ASSERT_EQ(mistakes.pictured, 15);
    ASSERT_EQ(mistakes.meshes.size(), 4u);
    EXPECT_NEAR(vertex_rms(mistakes.meshes[0].mesh.X, study.mesh().X), study.reconstructions[1].difference.rms, 1e-12);
}

// A dumbbell's thin parts lose their girth first.
TEST(LimbStudy, ThinTubesNeedTheModesThatGoRoundThem) {
    TriangleMesh mesh = torus_mesh(96, 24, 1, 0.1);
    const SpectralStudy study = spectral_study_on(mesh, "ring_limbs", {5, 40});
    const LimbStudy limbs = limb_study(study);
    ASSERT_TRUE(limbs.measured());
    EXPECT_NEAR(limbs.thin_diameter, 0.2, 0.01);
    EXPECT_NEAR(limbs.thick_diameter, 0.2, 0.01);
    ASSERT_GT(limbs.modes_needed, 0);
    // Round the tube μ ≈ 1/r² = 100, along it l² with two modes each: those with l < 10 come before.
    EXPECT_NEAR(limbs.modes_needed, 1 + 2 * 10, 3);
    EXPECT_GT(limbs.errors.front().thin, 0.5 * 0.1) << "at k = 5 the ring is its own axis";
    EXPECT_LT(limbs.errors.back().thin, 0.02) << "at k = 40 it has its girth";
}

TEST(LimbStudy, SharesAndCorrelationsOfPlantedErrors) {
    SpectralStudy study = spectral_study_on(ellipsoid_mesh(3, {3, 1, 1}), "cigar_limbs", {5});
    Reconstruction& r = study.reconstructions.front();
    const Vector along = study.mesh().X.col(0).cwiseAbs();
    r.distance = (along.array() > 2.5).select(Vector::Ones(along.size()), 0);   // only the tips
    LimbStudy limbs = limb_study(study);
    EXPECT_GT(limbs.thick_diameter, 1.9);
    EXPECT_LT(limbs.thin_diameter, 1.6);
    EXPECT_EQ(limbs.errors.front().thick, 0);
    EXPECT_GT(limbs.errors.front().thin, 0.3);
    EXPECT_GT(limbs.errors.front().far_share, 0.9);
    r.distance = along;
    EXPECT_LT(limb_study(study).errors.front().rank_correlation, -0.9);
    r.distance = (3 - along.array()).matrix();
    limbs = limb_study(study);
    EXPECT_GT(limbs.errors.front().rank_correlation, 0.9);
    EXPECT_LT(limbs.errors.front().far_share, 0.02);
}

TEST(LimbStudy, AnOpenSurfaceHasNone) { EXPECT_FALSE(limb_study(spectral_study_on(grid_mesh(12, 12, 1, 1), "sheet", {5})).measured()); }

TEST(ModeCost, GrowsAsCounted) {
    const ModeCost one = mode_cost(10, 1000, 5e4), two = mode_cost(20, 1000, 5e4);
    EXPECT_EQ(two.solve_operations, 2 * one.solve_operations);
    EXPECT_EQ(two.orthogonalise_operations, 4 * one.orthogonalise_operations);
    EXPECT_EQ(two.rebuild_operations, 2 * one.rebuild_operations);
    EXPECT_EQ(mode_cost(100, 1000, 5e4).solve_operations, mode_cost(100, 1000, 5e4).orthogonalise_operations) << "k = 2 entries/n";
    const SpectralStudy study = spectral_study_on(egg(), "egg_cost", {5});
    EXPECT_GE(factor_entries(study), (study.laplacian.C.nonZeros() + study.vertices()) / 2.0) << "half of C at least";
}
