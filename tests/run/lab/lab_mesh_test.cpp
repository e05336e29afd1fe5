#include "run/lab/lab_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/chapter.h"
#include "questions/q7_denoising/study.h"

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
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {{"q4", {}}, {"q5", {}}, {"q6", {}}});
    const DenseMatrix Phi = lab.modes.restored();
    ASSERT_GE(lab.readings.size(), 20u);
    for (const LabReading& reading : lab.readings) {
        const LabSetting& setting = reading.setting;
        DenseMatrix c = lab.coefficients;
        for (Eigen::Index i = 0; i < c.rows(); ++i) c.row(i) *= factor(lab, setting, i);
        const double energy = 0.5 * lab.eigenvalues.dot(c.rowwise().squaredNorm());
        EXPECT_NEAR(energy / reading.energy, 1, 1e-4) << setting.scheme << ' ' << setting.lambda << ' ' << setting.count;
        const double volume = signed_volume(moved_to(lab.mesh, Phi * c), Vector3::Zero());
        EXPECT_NEAR(volume / reading.volume, 1, 1e-4) << setting.scheme << ' ' << setting.lambda << ' ' << setting.count;
    }
}

namespace {

std::vector<LabReading>::const_iterator reading_at(const LabMesh& lab, const LabSetting& setting) {
    return std::ranges::find(lab.readings, setting, &LabReading::setting);
}

}   // namespace

TEST(LabMesh, EveryPresetAndEveryPanelHasTheProgramsNumbers) {
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {{"q4", {}}, {"q5", {}}, {"q6", {}}, {"q7", {}}, {"lab", {}}});
    for (const char* question : {"q4", "q5", "q6", "q7"})
        EXPECT_GE(std::ranges::count(lab.presets, question, &LabPreset::question), 3) << question;
    for (const LabPreset& preset : lab.presets) EXPECT_NE(reading_at(lab, preset.setting), lab.readings.end()) << preset.words;
    ASSERT_EQ(lab.starts.size(), 5u);
    for (const auto& [question, start] : lab.starts) EXPECT_NE(reading_at(lab, start), lab.readings.end()) << question;
}

// The report's own table of results, made by its own study.
TEST(LabMesh, GainsEqualThoseOfQuestion7) {
    QuestionSettings settings;
    settings.noise = {0.01};
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {{"q7", settings}});
    const auto cube = MeshLibrary({}, {}).role("cube");
    const q7_denoising::DenoisingGrid grid = q7_denoising::denoising_grid(cube, settings);
    const q7_denoising::NoisyTrial& trial = grid.trials.front();
    ASSERT_EQ(lab.mesh.vertex_count(), cube->mesh().vertex_count());
    for (std::size_t m = 0; m < measures.size(); ++m) {
        const SearchState& best = trial.best_by(measures[m]);
        const auto reading = reading_at(lab, {"denoising", best.value, best.step, 0.01, 1});
        ASSERT_NE(reading, lab.readings.end()) << measures[m].key;
        EXPECT_NEAR(reading->gains[m] / trial.gain(measures[m]), 1, 1e-9) << measures[m].key;
    }
}

TEST(LabMesh, HasTheNumbersOfTheReportsTables) {
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {{"q4", {}}, {"q5", {}}, {"q6", {}}});
    for (const int k : {5, 15, 30, 60, 150, 602}) EXPECT_NE(reading_at(lab, {"projection", 0, k}), lab.readings.end()) << k;
    for (const double lambda : {0.05, 0.5, 0.95, 1.05}) EXPECT_NE(reading_at(lab, {"explicit", lambda, 50}), lab.readings.end()) << lambda;
    for (const double lambda : {0.5, 5.0, 50.0})
        for (const int t : {1, 3, 10, 30, 100})
            EXPECT_NE(reading_at(lab, {"implicit", lambda, t}), lab.readings.end()) << lambda << ' ' << t;
}

// λ_crit is 2/μ_max: a step of λ has λμ_max = 2 λ/λ_crit.
TEST(LabMesh, TheFactorOfAStepIsThatOfTheFinestMode) {
    const LabMesh lab = lab_mesh(make_sample("cube"), "cube", {{"q4", {}}, {"q5", {}}, {"q6", {}}});
    for (const LabReading& reading : lab.readings) {
        const double step = 2 * reading.setting.lambda;
        const std::map<std::string, double> factors{{"explicit", 1 - step}, {"implicit", 1 / (1 + step)}, {"heat", std::exp(-step)}};
        const auto known = factors.find(reading.setting.scheme);
        if (known != factors.end()) {
            EXPECT_NEAR(reading.factor, known->second, 1e-8) << known->first;
        }
        EXPECT_EQ(std::isnan(reading.factor), reading.setting.scheme == "projection") << reading.setting.scheme;
    }
}

TEST(LabPresets, APanelOpensWithTheUsersOwnSettings) {
    const LabScale scale{.critical = 0.01, .modes = 400, .has_all = true};
    QuestionSettings own;
    own.k = {7, 9};
    own.lambda = {0.02};
    own.iterations = {12, 40};
    EXPECT_EQ(chapter_of_id("q4").lab->start(own, scale, {}), (LabSetting{"projection", 0, 9}));   // nearest to 15
    EXPECT_EQ(chapter_of_id("q5").lab->start(own, scale, {}),
              (LabSetting{"explicit", 2, 40}));   // 0.02 of an area, 0.01 the largest stable one
    EXPECT_EQ(chapter_of_id("q6").lab->start(own, scale, {}), (LabSetting{"implicit", 2, 12}));
    BestDenoising weak{.sigma = 0.003, .seed = 5, .found = {}}, strong{.sigma = 0.02, .seed = 5, .found = {}};
    weak.found.by_shape = {.value = 0.1, .step = 4};
    EXPECT_EQ(chapter_of_id("q7").lab->start(own, scale, {weak, strong}), (LabSetting{"denoising", 0.1, 4, 0.003, 5}));
}

TEST(LabPresets, FewModesLimitThePresets) {
    TriangleMesh tetrahedron;
    tetrahedron.X.resize(4, 3);
    tetrahedron.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    tetrahedron.F.resize(4, 3);
    tetrahedron.F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
    const LabMesh lab = lab_mesh(tetrahedron, "tetrahedron", {{"lab", {}}});
    for (const LabPreset& preset : lab.presets) {
        const bool projects = preset.setting.scheme == "projection";
        EXPECT_TRUE(!projects || preset.setting.count <= 4) << preset.words;
    }
    EXPECT_EQ(lab.starts.at("lab").count, 4);
}

TEST(LabMesh, ASurfaceWithoutInsideHasNoVolume) {
    TriangleMesh plane;   // projective: six vertices, every two of them joined
    plane.X = Positions::Random(6, 3);
    plane.F.resize(10, 3);
    plane.F << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 1, 1, 2, 4, 2, 3, 5, 3, 4, 1, 4, 5, 2, 5, 1, 3;
    EXPECT_FALSE(lab_mesh(plane, "plane", {}).is_closed);
    EXPECT_TRUE(lab_mesh(icosphere(1), "sphere", {}).is_closed);
}

TEST(LabMesh, LargeMeshesAreDecimatedAndItsRoundingIsMeasured) {
    const LabMesh lab = lab_mesh(make_sample("creature"), "creature", {}, {.vertices = 400, .decimated_to = 200});
    EXPECT_EQ(lab.mesh.vertex_count(), 200);
    EXPECT_TRUE(lab.is_decimated && lab.is_closed && lab.has_all_modes());
    EXPECT_EQ(lab.source_vertices, 6066);
    EXPECT_GT(lab.quantisation_shift, 1e-9);
    EXPECT_LT(lab.quantisation_shift, 1e-4);
}

TEST(LabMesh, BeyondItsLimitThereAreTheLowestModesAndOnlyProjections) {
    const LabMesh lab = lab_mesh(icosphere(3), "sphere", {{"lab", {}}}, {.vertices = 1000, .all_modes = 100, .fewer_modes = 40});
    EXPECT_EQ(lab.mesh.vertex_count(), 642);
    EXPECT_EQ(lab.eigenvalues.size(), 40);
    EXPECT_FALSE(lab.has_all_modes());
    EXPECT_GT(lab.largest_eigenvalue, lab.eigenvalues[39]);
    ASSERT_FALSE(lab.readings.empty());
    for (const LabReading& reading : lab.readings) EXPECT_EQ(reading.setting.scheme, "projection");
    EXPECT_EQ(lab_mesh(icosphere(3), "sphere", {}, {.vertices = 1000, .all_modes = 100, .numbers = 642 * 30 + 1}).eigenvalues.size(), 30);
}

// Modes that move the vertices less have fewer steps.
TEST(LabMesh, FewerModesAreRoundedByWhatTheyMove) {
    const LabMesh lab = lab_mesh(make_sample("creature"), "creature", {}, {.vertices = 10000});
    const auto [least, most] = std::ranges::minmax(lab.modes.numbers);
    EXPECT_EQ(std::max(-least, +most), QuantisedModes::largest);
    const Eigen::Map<const Eigen::Matrix<std::int16_t, Eigen::Dynamic, Eigen::Dynamic>> numbers(lab.modes.numbers.data(), lab.modes.rows,
                                                                                                lab.eigenvalues.size());
    EXPECT_LT(numbers.cast<int>().col(lab.eigenvalues.size() - 1).cwiseAbs().maxCoeff(), QuantisedModes::largest / 4);
    EXPECT_LT(lab.quantisation_shift, 1e-4);
}

TEST(LabMesh, ThePageBeginsAtTheSight) {
    LabMesh lab = lab_mesh(icosphere(1), "sphere", {});
    const auto header = [&lab] {
        const std::string bytes = bytes_of(lab);
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data(), 4);
        return nlohmann::json::parse(bytes.substr(4, length));
    };
    EXPECT_FALSE(header().contains("up") || header().contains("zoom"));
    lab.sight = {.camera = render::Angles{90, 0, 0}, .zoom = 2};
    EXPECT_EQ(header()["from"], nlohmann::json({1.0, 0.0, 0.0}));
    EXPECT_EQ(header()["up"], nlohmann::json({0.0, 1.0, 0.0}));
    EXPECT_EQ(header()["zoom"], 2);
    lab.sight = {.camera = render::Angles{0, 0, 0}, .up = render::Up::z};
    EXPECT_EQ(header()["from"], nlohmann::json({0.0, -1.0, 0.0}));
    EXPECT_EQ(header()["up"], nlohmann::json({0.0, 0.0, 1.0}));
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
