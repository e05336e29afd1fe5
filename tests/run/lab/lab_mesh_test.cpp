#include "run/lab/lab_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

double factor(const LabMesh& lab, const LabSetting& setting, Eigen::Index i) {
    const double step = setting.lambda * lab.critical() * lab.eigenvalues[i];
    if (setting.scheme == "projection") return i < setting.count ? 1 : 0;
    if (setting.scheme == "implicit") return std::pow(1 + step, -setting.count);
    if (setting.scheme == "heat") return std::exp(-step * setting.count);
    const double inverse_back = 0.05 * lab.largest_eigenvalue - 1 / (setting.lambda * lab.critical());
    const double back = setting.scheme == "taubin" ? 1 - lab.eigenvalues[i] / inverse_back : 1;
    return std::pow((1 - step) * back, setting.count);
}

}   // namespace

// The page's own formula, with the rounded modes: the program's steps lead to the same numbers.
TEST(LabMesh, SumsOverTheRoundedModesGiveTheProgramsReadings) {
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {{"q5", {}}});
    const DenseMatrix Phi = lab.modes.restored();
    ASSERT_GE(lab.readings.size(), 20u);
    for (const LabReading& reading : lab.readings) {
        const LabSetting& setting = reading.setting;
        DenseMatrix c = lab.coefficients;
        if (setting.sigma > 0) {
            const Positions noise =
                with_gaussian_noise(Positions::Zero(lab.mesh.X.rows(), 3), Vector3::Constant(setting.sigma * lab.diagonal), setting.seed);
            c += Phi.transpose() * (lab.laplacian.M.asDiagonal() * noise);
        }
        for (Eigen::Index i = 0; i < c.rows(); ++i) c.row(i) *= factor(lab, setting, i);
        const double energy = 0.5 * lab.eigenvalues.dot(c.rowwise().squaredNorm());
        EXPECT_NEAR(energy / reading.energy, 1, 1e-4) << setting.scheme << ' ' << setting.lambda << ' ' << setting.count;
        const double volume = signed_volume(moved_to(lab.mesh, Phi * c), Vector3::Zero());
        EXPECT_NEAR(volume / reading.volume, 1, 1e-4) << setting.scheme << ' ' << setting.lambda << ' ' << setting.count;
    }
}

TEST(LabMesh, EveryPresetHasTheProgramsNumbersAndTheBestOfTheNoiseIsTheLeast) {
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {});
    ASSERT_EQ(lab.presets.size(), lab_presets().size());
    const auto reading_at = [&](const LabSetting& setting) {
        return std::find_if(lab.readings.begin(), lab.readings.end(), [&](const LabReading& r) {
            return r.setting.scheme == setting.scheme && r.setting.lambda == setting.lambda && r.setting.count == setting.count &&
                   r.setting.sigma == setting.sigma;
        });
    };
    double least = INFINITY, best = INFINITY;
    for (const LabPreset& preset : lab.presets) {
        ASSERT_NE(reading_at(preset.setting), lab.readings.end()) << preset.words;
        if (preset.words == "best t for this noise") best = reading_at(preset.setting)->rms;
    }
    for (const LabReading& reading : lab.readings) {
        if (reading.setting.sigma > 0) least = std::min(least, reading.rms);
    }
    EXPECT_EQ(best, least);
}

// The constant mode does not count: it would make every factor at least 1.
TEST(LabMesh, TheLargestFactorOfAStepIsThatOfTheFinestOrOfTheCoarsestMode) {
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {});
    const double coarsest = lab.eigenvalues[1];
    for (const LabReading& reading : lab.readings) {
        const double step = reading.setting.lambda * lab.critical();
        double largest = reading.factor;
        if (reading.setting.scheme == "implicit") largest = 1 / (1 + step * coarsest);
        if (reading.setting.scheme == "heat") largest = std::exp(-step * coarsest);
        if (reading.setting.scheme == "explicit") largest = std::max(1 - step * coarsest, 2 * reading.setting.lambda - 1);
        EXPECT_NEAR(reading.factor, largest, 1e-8);
    }
}

TEST(LabPresets, APanelOpensWithTheUsersOwnSettings) {
    QuestionSettings own, one_step;
    own.k = {7, 9};
    own.lambda = {0.02};
    own.iterations = {12, 40};
    own.noise = {0.003};
    own.seed = 5;
    one_step.lambda = {1};
    EXPECT_EQ(start_of("q4", own, 0.01).count, 7);
    const LabSetting denoising = start_of("q7", own, 0.01);
    EXPECT_EQ(denoising.scheme, "explicit");
    EXPECT_EQ(denoising.lambda, 2);   // 0.02 of an area, 0.01 the largest stable one
    EXPECT_EQ(denoising.count, 12);
    EXPECT_EQ(denoising.sigma, 0.003);
    EXPECT_EQ(denoising.seed, 5u);
    EXPECT_EQ(start_of("q5", one_step, 3).lambda, 0.3333);
    EXPECT_EQ(start_of("q6", {}, 3).scheme, "implicit");
}

TEST(LabMesh, LargeMeshesAreDecimatedAndItsRoundingIsMeasured) {
    const LabMesh lab = lab_mesh(make_sample("creature"), "creature", {}, {.vertices = 400, .decimated_to = 200});
    EXPECT_EQ(lab.mesh.vertex_count(), 200);
    EXPECT_TRUE(lab.is_decimated && lab.is_closed && lab.has_all_modes());
    EXPECT_EQ(lab.source_vertices, 6066);
    EXPECT_GT(lab.quantisation_shift, 1e-9);
    EXPECT_LT(lab.quantisation_shift, 1e-4);
    EXPECT_LT(lab.orthonormality_error, 1e-3);
}

TEST(LabMesh, BeyondItsLimitThereAreTheLowestModesAndOnlyProjections) {
    const LabMesh lab = lab_mesh(icosphere(3), "sphere", {}, {.vertices = 0, .all_modes = 100, .fewer_modes = 40});
    EXPECT_EQ(lab.mesh.vertex_count(), 642);
    EXPECT_EQ(lab.eigenvalues.size(), 40);
    EXPECT_FALSE(lab.has_all_modes());
    EXPECT_GT(lab.largest_eigenvalue, lab.eigenvalues[39]);
    for (const LabReading& reading : lab.readings) EXPECT_EQ(reading.setting.scheme, "projection");
}

TEST(LabMesh, BytesHoldWhatTheHeaderSays) {
    const LabMesh lab = lab_mesh(icosphere(1), "\xff<sphere>", {});
    const std::string bytes = bytes_of(lab);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    ASSERT_EQ((length + 4) % 8, 0u);
    const auto header = nlohmann::json::parse(bytes.substr(4, length));
    const std::size_t n = header["vertices"], k = header["modes"], m = header["triangles"];
    EXPECT_EQ(n, 42u);
    EXPECT_EQ(bytes.size(), 4 + length + 8 * (k + n + 3 * n + 3 * k + k) + 12 * m + 2 * n * k);
    double first = 0;
    std::memcpy(&first, bytes.data() + 4 + length + 8, 8);
    EXPECT_EQ(first, lab.eigenvalues[1]);
}
