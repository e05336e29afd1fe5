// Small scenes that together show what the renderer can do. Tolerance and what happens on failure: golden.h.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <limits>

#include "render/golden.h"
#include "render/shapes.h"
#include "source_dir.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using render::DrawOptions;
using render::Image;
using render_tests::Mesh;

const fs::path golden_folder = fs::path(MESHFOLIO_SOURCE_DIR) / "tests/render/golden";

/// Seen three-quarter from above when drawn from +z.
Mesh turned(Mesh mesh) {
    const double c = std::cos(0.6), s = std::sin(0.6), C = std::cos(0.5), S = std::sin(0.5);
    const glm::dmat3 about_y(c, 0, -s, 0, 1, 0, s, 0, c), about_x(1, 0, 0, 0, C, S, 0, -S, C);
    for (glm::dvec3& p : mesh.positions) p = about_x * about_y * p;
    return mesh;
}

/// The sheet z = x² − y² with its heights as values.
Mesh saddle() {
    Mesh mesh = render_tests::grid(24);
    for (glm::dvec3& p : mesh.positions) {
        p.z = 0.6 * (p.x * p.x - p.y * p.y);
        mesh.values.push_back(p.z);
    }
    return mesh;
}

/// A bowl open to the viewer: its inside is the back.
Mesh bowl() {
    Mesh mesh = render_tests::grid(24);
    for (glm::dvec3& p : mesh.positions) p = {p.x, 0.9 * (p.x * p.x + p.z * p.z + p.y * p.y) - 0.6, p.y};
    return mesh;
}

Image small_picture(const Mesh& mesh, DrawOptions options) {
    options.width = options.height = 144;
    return render::draw_views(mesh.surface(), std::array{render::view_named("+z")}, options).front();
}

void expect_golden(const std::string& name, const Image& image) {
    const bool update = std::getenv("MESHFOLIO_UPDATE") != nullptr;
    const std::string complaint =
        render_tests::golden_complaint(name, image, golden_folder, fs::temp_directory_path() / "meshfolio_golden", update);
    EXPECT_TRUE(complaint.empty()) << complaint;
}

TEST(Golden, PebbleWithValues) {
    expect_golden("pebble", small_picture(render_tests::pebble(), {.range = {&render::colormap_named("viridis"), -500, 500}}));
}

TEST(Golden, BoxWithEdges) {
    expect_golden("box_edges", small_picture(turned(render_tests::box({-2, -1, -1.5}, {2, 1, 1.5})), {.edges = true}));
}

TEST(Golden, IsolinesMarksAndCreasesFromThreeQuarters) {
    Mesh mesh = render_tests::box({-1, -1, -1}, {1, 1, 1});
    const Mesh stone = render_tests::pebble();
    for (const glm::ivec3& t : stone.triangles) mesh.triangles.push_back(t + 8);
    for (const glm::dvec3& p : stone.positions) mesh.positions.push_back(0.0025 * p + glm::dvec3(0, 1.9, 0));
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.y + 0.3 * p.x);
    const std::vector<int> marks{7, 5, 0};   // one of them behind
    DrawOptions options{.range = {&render::colormap_named("viridis"), -1.3, 3}, .isoline_spacing = 0.4, .marked_vertices = marks};
    options.width = options.height = 144;
    expect_golden("hero", render::draw_views(mesh.surface(), std::array{render::three_quarter_view()}, options).front());
}

TEST(Golden, ABowlShowsItsBack) { expect_golden("bowl", small_picture(turned(bowl()), {})); }

TEST(Golden, SaddleWithSignedAndUndefinedValues) {
    Mesh mesh = saddle();
    for (std::size_t i = 0; i < mesh.values.size(); ++i)
        if (glm::length(mesh.positions[i] - glm::dvec3(0.5, 0.4, 0)) < 0.25) mesh.values[i] = std::numeric_limits<double>::quiet_NaN();
    expect_golden("saddle", small_picture(turned(mesh), {.range = {&render::colormap_named("diverging"), -0.6, 0.6}}));
}

TEST(Golden, PhasesOnATransparentGround) {
    Mesh mesh = render_tests::grid(40);
    for (glm::dvec3& p : mesh.positions) {
        p.z = 0.2 * std::cos(6 * std::hypot(p.x, p.y));
        mesh.values.push_back(1.5 * p.x);
    }
    expect_golden("phases",
                  small_picture(turned(mesh), {.range = {&render::colormap_named("cyclic"), -1.5, 1.5}, .background = {255, 255, 255, 0}}));
}

// ---- the harness itself ---------------------------------------------------------------------------------------------

class GoldenHarness : public testing::Test {
protected:
    const meshfolio::testing_tools::TemporaryFolder temporary_;
    const fs::path folder_ = temporary_.path();
    const Image picture_ = small_picture(render_tests::pebble(), {.background = {0, 0, 0, 0}});

    std::string complaint_about(const Image& image, bool update = false) const {
        return render_tests::golden_complaint("pebble", image, folder_ / "golden", folder_ / "review", update);
    }
};

TEST_F(GoldenHarness, WhatWasUpdatedIsFoundGood) {
    EXPECT_EQ(complaint_about(picture_, true), "");
    EXPECT_EQ(complaint_about(picture_), "");
    EXPECT_EQ(render_tests::read_picture(folder_ / "golden/pebble.png").pixels, picture_.pixels);
    EXPECT_FALSE(fs::exists(folder_ / "review"));
}

TEST_F(GoldenHarness, OneLevelOfAChannelIsTolerated) {
    complaint_about(picture_, true);
    Image image = picture_;
    for (std::size_t i = 0; i < image.pixels.size(); i += 20) image.pixels[i].g = static_cast<std::uint8_t>(image.pixels[i].g ^ 1);
    EXPECT_EQ(complaint_about(image), "");
}

// A patch of 8 × 8 pixels a little lighter, and a picture a tenth darker all over.
TEST_F(GoldenHarness, WhatIsSeenIsComplainedOfWithASheetToLookAt) {
    complaint_about(picture_, true);
    Image patch = picture_, darker = picture_;
    for (int y = 70; y < 78; ++y)
        for (int x = 70; x < 78; ++x) patch.at(x, y).r = static_cast<std::uint8_t>(std::max(0, patch.at(x, y).r - 24));
    for (render::Rgba& p : darker.pixels)
        p = {static_cast<std::uint8_t>(0.9 * p.r), static_cast<std::uint8_t>(0.9 * p.g), static_cast<std::uint8_t>(0.9 * p.b), p.a};
    for (const Image& image : {patch, darker}) {
        const std::string complaint = complaint_about(image);
        const fs::path sheet = folder_ / "review/pebble.png";
        EXPECT_NE(complaint.find(sheet.string()), std::string::npos) << complaint;
        EXPECT_NE(complaint.find("MESHFOLIO_UPDATE=1"), std::string::npos);
        EXPECT_GT(render_tests::read_picture(sheet).width, 3 * 144);
        fs::remove(sheet);
    }
}

TEST_F(GoldenHarness, AMissingOrOtherSizedGoldenPictureIsComplainedOf) {
    EXPECT_NE(complaint_about(picture_), "");
    complaint_about(picture_, true);
    EXPECT_NE(complaint_about(Image(20, 30)), "");
}

}   // namespace
