#include "output/draw/draw_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/file_bytes.h"
#include "mesh/samples/sample_shapes.h"
#include "output/draw/finished_picture.h"
#include "output/draw/surface_of.h"
#include "scene/camera.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

Panel panel_of(TriangleMesh mesh, std::string name, bool with_values) {
    Panel panel;
    panel.name = std::move(name);
    panel.label = panel.name;
    if (with_values) panel.values = mesh.X.col(2);
    panel.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    return panel;
}

std::vector<FigureRequest> requests() {
    FigureRequest single{"q1_ball_h", "One", "icosphere", {panel_of(icosphere(2), "q1_ball_h", true)}, {}, false, 0};
    single.range = robust_range(single.panels, "viridis", "z", "length", 0);
    FigureRequest strip{
        "q5_cube", "Several", "cubes", {panel_of(cube_mesh(3), "q5_cube_a", false), panel_of(cube_mesh(3, 0.8), "q5_cube_b", true)},
        {},        true,      -1};
    strip.range = robust_range(strip.panels, "diverging", "z", "length", 0);
    return {single, strip};
}

DrawSettings small_pictures(int threads = 0) {
    DrawSettings settings;
    settings.width = 120;
    settings.height = 120;
    settings.sheet_cell = 60;
    settings.strip_cell = 40;
    settings.preview_width = 200;
    settings.threads = threads;
    return settings;
}

std::map<std::string, std::string> bytes_below(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files[entry.path().lexically_relative(folder).generic_string()] = read_file(entry.path());
    }
    return files;
}

int big_endian(const std::string& bytes, std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

}   // namespace

TEST(DrawFigures, AMeshFitsTheFrameOfAnotherUntilItIsWiderThanThePicture) {
    const TriangleMesh cube = cube_mesh(3);
    EXPECT_TRUE(fit_frame_of(cube, cube.X));
    EXPECT_TRUE(fit_frame_of(cube, cube.X / 0.921));   // the cube takes 0.92 of the picture
    EXPECT_FALSE(fit_frame_of(cube, cube.X / 0.919));
    Positions lost = cube.X;
    lost(0, 0) = NAN;
    EXPECT_FALSE(fit_frame_of(cube, lost));
}

TEST(DrawFigures, WritesEveryFileItNamesAndNoOther) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures(requests(), folder.path(), small_pictures());
    std::set<std::string> named;
    for (const auto& [id, figure] : drawn) {
        named.insert(figure.sheet);
        for (const auto& [label, path] : figure.views) named.insert(path);
    }
    std::set<std::string> written;
    for (const auto& [name, bytes] : bytes_below(folder.path())) written.insert(name);
    EXPECT_EQ(named, written);
    EXPECT_EQ(written.size(), 2u + 3u * 6u);
    EXPECT_TRUE(written.contains("images/q1_ball_h_+x.png"));
    EXPECT_TRUE(written.contains("images/q5_cube_sheet.png"));
}

TEST(DrawFigures, PicturesHaveTheirSize) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures(requests(), folder.path(), small_pictures());
    for (const auto& [label, path] : drawn.at("q5_cube").views) {
        const std::string png = read_file(folder.path() / path);
        EXPECT_EQ(big_endian(png, 16), 120) << path;
        EXPECT_EQ(big_endian(png, 20), 120) << path;
    }
    for (const auto& [id, figure] : drawn) {
        EXPECT_GT(figure.width, 0);
        EXPECT_LE(figure.width, 200);
        EXPECT_GT(figure.height, 0);
        EXPECT_TRUE(figure.preview_jpeg.starts_with("\xff\xd8\xff"));
    }
}

TEST(DrawFigures, FiguresForPaperKeepTheSizeOfTheirSheet) {
    const TemporaryFolder folder;
    DrawSettings settings = small_pictures();
    settings.preview_width = 60;
    settings.on_paper = {"q5_cube"};
    const auto drawn = draw_figures(requests(), folder.path(), settings);
    EXPECT_TRUE(drawn.at("q1_ball_h").print_jpeg.empty());
    const report::DrawnFigure& figure = drawn.at("q5_cube");
    const std::string png = read_file(folder.path() / figure.sheet);
    const std::size_t frame = figure.print_jpeg.find("\xff\xc0");   // its header holds height and width in two bytes each
    ASSERT_NE(frame, std::string::npos);
    const int size = big_endian(figure.print_jpeg, frame + 5);
    EXPECT_EQ(size >> 16, big_endian(png, 20));
    EXPECT_EQ(size & 0xffff, big_endian(png, 16));
}

TEST(DrawFigures, LabelsSayPanelAndView) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures(requests(), folder.path(), small_pictures());
    EXPECT_EQ(drawn.at("q1_ball_h").views.front().first, "+x");
    EXPECT_EQ(drawn.at("q5_cube").views.front().first, "q5_cube_a, +x");
    EXPECT_EQ(drawn.at("q5_cube").views.size(), 12u);
}

TEST(DrawFigures, SameBytesForAnyNumberOfThreads) {
    const TemporaryFolder one, two;
    const auto first = draw_figures(requests(), one.path(), small_pictures(1));
    const auto second = draw_figures(requests(), two.path(), small_pictures(2));
    EXPECT_EQ(bytes_below(one.path()), bytes_below(two.path()));
    for (const auto& [id, figure] : first) EXPECT_EQ(figure.preview_jpeg, second.at(id).preview_jpeg) << id;
}

TEST(DrawFigures, ReportsProgress) {
    const TemporaryFolder folder;
    std::vector<double> told;
    draw_figures(requests(), folder.path(), small_pictures(), [&](double fraction) { told.push_back(fraction); });
    EXPECT_EQ(told.size(), 3u);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_DOUBLE_EQ(told.back(), 1);
}

// A panel drawn on the box of a mesh ten times as large covers a tenth of the width.
TEST(DrawFigures, TheFramingPanelSetsTheScaleOfAll) {
    const auto bytes_of = [](int frame_panel) {
        const TemporaryFolder folder;
        FigureRequest request{
            "q5_a", "",    "",         {panel_of(cube_mesh(1), "q5_small", false), panel_of(cube_mesh(1, 5), "q5_large", false)},
            {},     false, frame_panel};
        draw_figures(std::vector{request}, folder.path(), small_pictures());
        return bytes_below(folder.path());
    };
    const auto on_small = bytes_of(0), on_large = bytes_of(1), on_union = bytes_of(-1);
    EXPECT_NE(on_small.at("images/q5_small_+x.png"), on_large.at("images/q5_small_+x.png"));
    EXPECT_EQ(on_large, on_union) << "the larger cube contains the smaller";
}

TEST(DrawFigures, RefusesNamesThatCollideOrLeaveTheFolder) {
    const TemporaryFolder folder;
    auto twice = requests();
    twice[1].panels[0].name = "q1_ball_h";
    EXPECT_THROW(draw_figures(twice, folder.path(), small_pictures()), std::logic_error);
    auto outside = requests();
    outside[0].panels[0].name = "../x";
    EXPECT_THROW(draw_figures(outside, folder.path(), small_pictures()), std::logic_error);
    EXPECT_TRUE(bytes_below(folder.path()).empty());
}

namespace {

/// Small multiples of balls of these radii, with z as values.
FigureRequest balls(const std::vector<double>& radii, bool one_frame) {
    FigureRequest request{"q4_balls", "Balls", "", {}, {}, false, -1};
    for (std::size_t i = 0; i < radii.size(); ++i) {
        TriangleMesh ball = icosphere(2);
        ball.X *= radii[i];
        request.panels.push_back(panel_of(std::move(ball), "q4_ball_" + std::to_string(i), true));
        request.panels.back().values /= radii[i];
    }
    request.layout = one_frame ? Layout::one_frame : Layout::multiples;
    request.range = robust_range(request.panels, "diverging", "z", "", 0);
    return request;
}

std::vector<std::string> pictures_of(const FigureRequest& request) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures({&request, 1}, folder.path(), small_pictures());
    std::vector<std::string> pictures;
    for (const auto& [label, path] : drawn.at(request.id).views) pictures.push_back(read_file(folder.path() / path));
    return pictures;
}

}   // namespace

TEST(DrawFigures, SmallMultiplesInOneFrameKeepTheirSizes) {
    const auto own = pictures_of(balls({1, 2}, false)), one = pictures_of(balls({1, 2}, true));
    EXPECT_EQ(own[0], own[1]) << "each fills its own frame";
    EXPECT_NE(one[0], one[1]);
    EXPECT_EQ(one[1], own[1]) << "the larger ball fills the frame of both";
    FigureRequest first = balls({1, 2}, true);
    first.frame_panel = 0;
    EXPECT_EQ(pictures_of(first)[0], own[0]) << "in the frame of the first the first fills it";
}

TEST(DrawFigures, IsolinesAreDrawnWhereTheyAreAskedFor) {
    FigureRequest with = balls({1}, false);
    with.isoline_spacing = 2;   // of values between −1 and 1: the line of 0
    EXPECT_NE(pictures_of(with)[0], pictures_of(balls({1}, false))[0]);
    with.isoline_spacing = 1e3;
    with.panels[0].values.array() += 10;   // no multiple is among the values
    with.range->low += 10;
    with.range->high += 10;
    FigureRequest without = with;
    without.isoline_spacing = 0;
    EXPECT_EQ(pictures_of(with)[0], pictures_of(without)[0]);
}

TEST(DrawFigures, AGalleryIsDrawnAtHalfTheSize) {
    const std::vector<double> twelve(12, 1.0), thirteen(13, 1.0);
    EXPECT_EQ(big_endian(pictures_of(balls(twelve, true))[0], 16), 120);
    const auto pictures = pictures_of(balls(thirteen, true));
    ASSERT_EQ(pictures.size(), 13u);
    EXPECT_EQ(big_endian(pictures[12], 16), 60);
}

// ---- comparisons --------------------------------------------------------------------------------------------------------

namespace {

/// A ball before and after, and by how much it shrank.
FigureRequest shrunk_ball() {
    FigureRequest request{
        "q5_pair",
        "Before and after",
        "",
        {panel_of(icosphere(2), "before", false), panel_of(icosphere(2, 0.8), "after", false), panel_of(icosphere(2, 0.8), "moved", true)},
        {},
        false,
        0};
    request.layout = Layout::comparison;
    request.range = robust_range({request.panels.back()}, "viridis", "displacement", "%", 0);
    return request;
}

}   // namespace

TEST(DrawFigures, AComparisonHasOnePreviewAPanelAllOfOneSize) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures(std::vector{shrunk_ball()}, folder.path(), small_pictures()).at("q5_pair");
    ASSERT_EQ(drawn.comparison.size(), 3u);
    for (const auto& panel : drawn.comparison) {
        const std::string png = read_file(folder.path() / panel.file);
        EXPECT_EQ(big_endian(png, 16), 120) << panel.file;
        EXPECT_EQ(big_endian(png, 20), 120) << panel.file;
        EXPECT_EQ(panel.width, 120) << "never enlarged";
        EXPECT_EQ(panel.height, 120);
        EXPECT_TRUE(panel.preview_jpeg.starts_with("\xff\xd8\xff"));
    }
    EXPECT_EQ(drawn.comparison[0].label, "before");
    EXPECT_EQ(drawn.comparison[0].file, "images/before_hero.png");
    EXPECT_NE(drawn.comparison[0].preview_jpeg, drawn.comparison[1].preview_jpeg);
    EXPECT_TRUE(draw_figures(requests(), folder.path(), small_pictures()).at("q5_cube").comparison.empty());
}

TEST(DrawFigures, OnlyTheDifferenceOfAComparisonHasColoursAndTheirBar) {
    const TemporaryFolder folder, other;
    FigureRequest request = shrunk_ball();
    const auto drawn = draw_figures(std::vector{request}, folder.path(), small_pictures()).at("q5_pair");
    request.range->quantity = "something else";
    const auto named = draw_figures(std::vector{request}, other.path(), small_pictures()).at("q5_pair");
    for (const std::size_t plain : {0u, 1u}) EXPECT_EQ(drawn.comparison[plain].preview_jpeg, named.comparison[plain].preview_jpeg);
    EXPECT_NE(drawn.comparison[2].preview_jpeg, named.comparison[2].preview_jpeg) << "its bar names the quantity";
}

TEST(DrawFigures, RefusesAComparisonOfOnePanelOrInTwoFrames) {
    const TemporaryFolder folder;
    FigureRequest alone = shrunk_ball();
    alone.panels.resize(1);
    EXPECT_THROW(draw_figures(std::vector{alone}, folder.path(), small_pictures()), std::logic_error);
}

TEST(PreviewOf, ShrinksButNeverEnlarges) {
    render::Image picture(40, 20);
    picture.at(3, 3) = {200, 10, 10, 255};
    const Preview same = preview_of(picture, 40, 82), smaller = preview_of(picture, 10, 82), larger = preview_of(picture, 400, 82);
    EXPECT_EQ(same.jpeg, larger.jpeg);
    EXPECT_EQ(larger.width, 40);
    EXPECT_EQ(smaller.width, 10);
    EXPECT_EQ(smaller.height, 5);
}
