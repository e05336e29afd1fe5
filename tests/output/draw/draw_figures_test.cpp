#include "output/draw/draw_figures.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <map>
#include <set>

#include "base/file_bytes.h"
#include "mesh/samples/sample_shapes.h"
#include "output/draw/finished_picture.h"
#include "output/draw/framing.h"
#include "output/draw/surface_of.h"
#include "png/png.h"
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

const DrawSettings small_pictures{.width = 120, .height = 120, .view_files = true};

std::map<std::string, std::string> bytes_below(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files[entry.path().lexically_relative(folder).generic_string()] = read_file(entry.path());
    }
    return files;
}

std::vector<report::DrawnPicture> pictures_of(const report::DrawnFigure& figure) {
    std::vector<report::DrawnPicture> all;
    for (const report::DrawnPanel& panel : figure.panels) all.insert(all.end(), panel.pictures.begin(), panel.pictures.end());
    return all;
}

int big_endian(const std::string& bytes, std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

}   // namespace

TEST(DrawFigures, AMeshFitsTheFrameOfAnotherUntilItIsWiderThanThePicture) {
    const TriangleMesh cube = cube_mesh(3);
    EXPECT_TRUE(fits_frame(bounds_of(cube), cube.X));
    EXPECT_TRUE(fits_frame(bounds_of(cube), cube.X / 0.921));   // the cube takes 0.92 of the picture
    EXPECT_FALSE(fits_frame(bounds_of(cube), cube.X / 0.919));
    Positions lost = cube.X;
    lost(0, 0) = NAN;
    EXPECT_FALSE(fits_frame(bounds_of(cube), lost));
}

TEST(DrawFigures, PositionsBeyondThePictureAreScaledAboutItsMiddle) {
    const TriangleMesh cube = cube_mesh(3);
    EXPECT_EQ(fitted_into_frame(cube, cube.X).scale, 1);
    Positions spiked = cube.X;
    spiked.row(0) *= 20;
    const FittedPositions fitted = fitted_into_frame(cube, spiked);
    EXPECT_LT(fitted.scale, 0.2);
    EXPECT_EQ(fitted_into_frame(cube, fitted.X).scale, 1) << "now it fits";
    EXPECT_NEAR((fitted.X.row(5) - fitted.X.row(9)).norm(), fitted.scale * (spiked.row(5) - spiked.row(9)).norm(), 1e-12);
}

// Every colour can be read as a number: in a bar for the figure, or in one for each panel that has a range of its own.
TEST(DrawFigures, TheEndsOfEveryBarAreTheRangeOfItsColours) {
    const TemporaryFolder folder;
    std::vector<FigureRequest> figures = requests();
    FigureRequest& own = figures[1];
    for (Panel& panel : own.panels) {
        panel.values = panel.mesh->X.col(2) * (panel.name == "q5_cube_a" ? 1 : 1000);
        panel.range = robust_range({panel}, "diverging", "z", "length", 0);
    }
    own.range.reset();
    const auto drawn = draw_figures(figures, folder.path(), small_pictures);
    const auto expect_bar = [](const std::optional<report::Legend>& legend, const ColorRange& range) {
        ASSERT_TRUE(legend);
        EXPECT_EQ(legend->low, range.low);
        EXPECT_EQ(legend->high, range.high);
        EXPECT_EQ(legend->unit, range.unit);
        EXPECT_FALSE(legend->colours.empty());
    };
    expect_bar(drawn.at("q1_ball_h").legend, *figures[0].range);
    EXPECT_FALSE(drawn.at("q5_cube").legend);
    for (std::size_t p = 0; p < 2; ++p) expect_bar(drawn.at("q5_cube").panels[p].legend, *own.panels[p].range);
    EXPECT_GT(drawn.at("q5_cube").panels[1].legend->high, 100 * drawn.at("q5_cube").panels[0].legend->high);
    const auto jpeg_of = [&](std::size_t p) { return drawn.at("q5_cube").panels[p].pictures[0].jpeg; };
    EXPECT_NE(jpeg_of(0), jpeg_of(1)) << "the cubes differ in size";
}

TEST(DrawFigures, ScalingValuesAndRangeByAThousandKeepsThePicture) {
    std::vector<FigureRequest> figures(1, requests()[0]);
    figures[0].range.reset();
    const auto jpeg_with = [&](double factor) {
        const TemporaryFolder folder;
        Panel& panel = figures[0].panels[0];
        panel.values = factor * panel.mesh->X.col(2);
        panel.range = robust_range({panel}, "diverging", "z", "", 0);
        return draw_figures(figures, folder.path(), small_pictures).at("q1_ball_h").panels[0].pictures[0].jpeg;
    };
    EXPECT_EQ(jpeg_with(1), jpeg_with(1024));
}

TEST(DrawFigures, GapsInsidePairsAreSmallerThanBetweenPairs) {
    const TemporaryFolder folder;
    FigureRequest request{"q5_pairs", "Pairs", "", {}, {}};
    for (const char* name : {"a", "b", "c", "d"}) request.panels.push_back(panel_of(icosphere(1), name, false));
    request.states = 2;
    const auto drawn = draw_figures(std::vector{request}, folder.path(), small_pictures).at("q5_pairs");
    const auto top = [&](std::size_t p) { return drawn.panels[p].pictures[0].top; };
    EXPECT_EQ(drawn.states, 2);
    EXPECT_LT(top(1) - top(0), top(2) - top(1));
    EXPECT_EQ(top(3) - top(2), top(1) - top(0));
}

TEST(DrawFigures, WritesExactlyTheFilesThatItNames) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures(requests(), folder.path(), small_pictures);
    std::set<std::string> named;
    for (const auto& [id, figure] : drawn) {
        named.insert(figure.sheet);
        for (const report::DrawnPicture& picture : pictures_of(figure)) {
            if (!picture.file.empty()) named.insert(picture.file);
        }
    }
    std::set<std::string> written;
    for (const auto& [name, bytes] : bytes_below(folder.path())) written.insert(name);
    EXPECT_EQ(named, written);
    EXPECT_EQ(written.size(), 2u + 3u * 6u);
    EXPECT_TRUE(written.contains("images/q1_ball_h_+x.png"));
    EXPECT_TRUE(written.contains("images/q5_cube_sheet.png"));
}

TEST(DrawFigures, ViewFilesAreWrittenOnRequest) {
    const TemporaryFolder folder;
    DrawSettings settings = small_pictures;
    settings.view_files = false;
    auto asked = requests();
    asked[0].view_files = true;
    const auto drawn = draw_figures(asked, folder.path(), settings);
    EXPECT_EQ(bytes_below(folder.path()).size(), 2u + 6u);
    for (const report::DrawnPicture& picture : pictures_of(drawn.at("q1_ball_h"))) {
        if (picture.view.empty()) continue;
        const std::string png = read_file(folder.path() / picture.file);
        EXPECT_EQ(big_endian(png, 16), 120) << picture.file;
        EXPECT_EQ(big_endian(png, 20), 120) << picture.file;
    }
    for (const report::DrawnPicture& picture : pictures_of(drawn.at("q5_cube"))) EXPECT_TRUE(picture.file.empty());
    const TemporaryFolder other;
    settings.sheets_only = true;
    draw_figures(asked, other.path(), settings);
    EXPECT_EQ(bytes_below(other.path()).size(), 2u);
}

// The page shows nothing that is not in the sheet: a report rendered from its files is the same.
TEST(DrawFigures, PicturesAreCutOutOfTheSheet) {
    const TemporaryFolder folder;
    for (auto& [id, figure] : draw_figures(requests(), folder.path(), small_pictures)) {
        const auto sheet = render::decode_png(read_file(folder.path() / figure.sheet));
        ASSERT_TRUE(sheet);
        report::DrawnFigure again = figure;
        for (report::DrawnPanel& panel : again.panels)
            for (report::DrawnPicture& picture : panel.pictures) picture.jpeg.clear();
        ASSERT_TRUE(cut_pictures(*sheet, again));
        EXPECT_EQ(again, figure);
        const report::DrawnPicture last = pictures_of(figure).back();
        const std::size_t frame = last.jpeg.find("\xff\xc0");   // its header holds height and width in two bytes each
        ASSERT_NE(frame, std::string::npos);
        EXPECT_EQ(big_endian(last.jpeg, frame + 5), last.height << 16 | last.width);
        again.panels.back().pictures.back().left = sheet->width - 1;
        EXPECT_FALSE(cut_pictures(*sheet, again)) << "beyond the sheet";
    }
}

TEST(DrawFigures, PicturesOfAFigureDoNotOverlap) {
    const TemporaryFolder folder;
    for (const auto& [id, figure] : draw_figures(requests(), folder.path(), small_pictures)) {
        const std::vector<report::DrawnPicture> all = pictures_of(figure);
        EXPECT_EQ(all.size(), 7 * figure.panels.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const bool apart = all[i].left >= all[j].left + all[j].width || all[j].left >= all[i].left + all[i].width ||
                                   all[i].top >= all[j].top + all[j].height || all[j].top >= all[i].top + all[i].height;
                EXPECT_TRUE(apart) << id << ' ' << i << ' ' << j;
            }
    }
}

TEST(DrawFigures, SameBytesForAnyNumberOfThreads) {
    const TemporaryFolder one, two;
    const auto drawn_by = [](int threads, const fs::path& folder) {
        return tbb::task_arena(threads).execute([&] { return draw_figures(requests(), folder, small_pictures); });
    };
    const auto first = drawn_by(1, one.path()), second = drawn_by(2, two.path());
    EXPECT_EQ(bytes_below(one.path()), bytes_below(two.path()));
    EXPECT_EQ(first, second);
}

TEST(DrawFigures, ReportsProgress) {
    const TemporaryFolder folder;
    std::vector<double> told;
    draw_figures(requests(), folder.path(), small_pictures, [&](double share) { told.push_back(share); });
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
        draw_figures(std::vector{request}, folder.path(), small_pictures);
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
    EXPECT_THROW(draw_figures(twice, folder.path(), small_pictures), std::logic_error);
    auto outside = requests();
    outside[0].panels[0].name = "../x";
    EXPECT_THROW(draw_figures(outside, folder.path(), small_pictures), std::logic_error);
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

std::vector<std::string> files_of(const FigureRequest& request) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures({&request, 1}, folder.path(), small_pictures);
    std::vector<std::string> pictures;
    for (const report::DrawnPicture& picture : pictures_of(drawn.at(request.id)))
        pictures.push_back(read_file(folder.path() / picture.file));
    return pictures;
}

}   // namespace

TEST(DrawFigures, SmallMultiplesInOneFrameKeepTheirSizes) {
    const auto own = files_of(balls({1, 2}, false)), one = files_of(balls({1, 2}, true));
    EXPECT_EQ(own[0], own[1]) << "each fills its own frame";
    EXPECT_NE(one[0], one[1]);
    EXPECT_EQ(one[1], own[1]) << "the larger ball fills the frame of both";
    FigureRequest first = balls({1, 2}, true);
    first.frame_panel = 0;
    EXPECT_EQ(files_of(first)[0], own[0]) << "in the frame of the first the first fills it";
}

TEST(DrawFigures, IsolinesAreDrawnOnRequest) {
    FigureRequest with = balls({1}, false);
    with.isoline_spacing = 2;   // of values between −1 and 1: the line of 0
    EXPECT_NE(files_of(with)[0], files_of(balls({1}, false))[0]);
    with.isoline_spacing = 1e3;
    with.panels[0].values.array() += 10;   // no multiple is among the values
    with.range->low += 10;
    with.range->high += 10;
    FigureRequest without = with;
    without.isoline_spacing = 0;
    EXPECT_EQ(files_of(with)[0], files_of(without)[0]);
}

TEST(DrawFigures, MoreThanTwelvePicturesAreSmall) {
    const TemporaryFolder folder;
    const auto drawn = draw_figures(std::vector{balls(std::vector<double>(3, 1.0), true)}, folder.path(), small_pictures);
    const auto many = draw_figures(std::vector{balls(std::vector<double>(9, 1.0), true)}, folder.path(), small_pictures);
    EXPECT_LT(many.at("q4_balls").panels[0].pictures[0].width, drawn.at("q4_balls").panels[0].pictures[0].width);
}

// ---- cropping ----------------------------------------------------------------------------------------------------------

namespace {

/// The six views of one mesh, by name.
std::map<std::string, report::DrawnPicture> views_of(TriangleMesh mesh) {
    const TemporaryFolder folder;
    const FigureRequest request{"q1_one", "", "", {panel_of(std::move(mesh), "q1_one_panel", false)}, {}};
    std::map<std::string, report::DrawnPicture> views;
    DrawSettings settings;
    settings.width = settings.height = 400;
    for (const report::DrawnPicture& picture : pictures_of(draw_figures(std::vector{request}, folder.path(), settings).at("q1_one")))
        views[picture.view] = picture;
    return views;
}

}   // namespace

TEST(DrawFigures, ViewsAreCroppedAtOneScale) {
    TriangleMesh bar = cube_mesh(1);
    bar.X.col(0) *= 4;   // 4 × 1 × 1
    const auto views = views_of(bar);
    const int side = views.at("+y").width;
    EXPECT_EQ(views.at("+z").width, side);
    EXPECT_EQ(views.at("+x").width, views.at("+x").height);
    const double margin = 2 * 0.03 * side;
    EXPECT_NEAR(views.at("+x").width, margin + (side - margin) / 4, 2);
    for (const char* axis : {"x", "y", "z"}) {
        const auto& front = views.at(std::string("+") + axis);
        const auto& behind = views.at(std::string("-") + axis);
        EXPECT_EQ(front.width, behind.width);
        EXPECT_EQ(front.height, behind.height);
    }
}

// Its side views would be hairlines.
TEST(DrawFigures, AFlatMeshHasOnlyItsFrontViewAndALabelThatSaysSo) {
    const auto flat_along = [](int axis) {
        TriangleMesh sheet = grid_mesh(4, 4, 1, 1);   // in the plane of x and y, seen from +z
        if (axis != 2) sheet.X.col(axis).swap(sheet.X.col(2));
        return sheet;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const TemporaryFolder folder;
        const FigureRequest request{
            "q1_flat", "", "", {panel_of(flat_along(axis), "q1_sheet", false), panel_of(icosphere(1), "q1_ball", false)}, {}};
        const auto drawn = draw_figures(std::vector{request}, folder.path(), small_pictures).at("q1_flat");
        ASSERT_EQ(drawn.panels[0].pictures.size(), 1u);
        const report::DrawnPicture& front = drawn.panels[0].pictures[0];
        const std::string side = axis == 2 ? "+z" : axis == 1 ? "-y" : "-x";   // a swap of axes mirrors it
        EXPECT_EQ(front.view, side);
        EXPECT_NE(drawn.panels[0].label.find("seen from " + front.direction() + "; its other views are edge-on"), std::string::npos);
        EXPECT_NE(front.file.find("_" + side + ".png"), std::string::npos) << front.file;
        EXPECT_EQ(drawn.panels[1].pictures.size(), 7u);
        EXPECT_EQ(drawn.panels[1].label, "q1_ball");
    }
}

// No view of a thin but not flat mesh is blank.
TEST(DrawFigures, NoPictureIsBlank) {
    const TemporaryFolder folder;
    TriangleMesh thin = icosphere(2);
    thin.X.col(2) *= 0.02;
    const FigureRequest request{
        "q1_thin", "", "", {panel_of(thin, "q1_disc", false), panel_of(grid_mesh(4, 4, 1, 1), "q1_sheet", false)}, {}};
    const auto drawn = draw_figures(std::vector{request}, folder.path(), {.view_files = true}).at("q1_thin");
    const auto sheet = render::decode_png(read_file(folder.path() / drawn.sheet));
    for (const report::DrawnPicture& picture : pictures_of(drawn)) {
        const render::Image part = part_of(*sheet, picture.left, picture.top, picture.width, picture.height);
        const auto covered = std::ranges::count_if(part.pixels, [](render::Rgba p) { return p != render::Rgba{255, 255, 255, 255}; });
        EXPECT_GT(static_cast<double>(covered), 0.05 * static_cast<double>(part.pixels.size())) << picture.view;
    }
}

// ---- matrices -------------------------------------------------------------------------------------------------------------

TEST(DrawFigures, AnEmptyCellOfAMatrixHasALabelAndNoPicture) {
    const TemporaryFolder folder;
    FigureRequest request = balls({1, 2, 3}, true);
    request.columns = {"a", "b"};
    request.rows = {"c", "d"};
    request.panels.insert(request.panels.begin() + 2, Panel{"", "blew up", nullptr, {}, {}});
    const auto drawn = draw_figures(std::vector{request}, folder.path(), small_pictures).at("q4_balls");
    EXPECT_TRUE(drawn.is_matrix());
    EXPECT_EQ(drawn.in_a_line, 2);
    ASSERT_EQ(drawn.panels.size(), 4u);
    EXPECT_TRUE(drawn.panels[2].pictures.empty());
    EXPECT_EQ(drawn.panels[2].label, "blew up");
    EXPECT_EQ(drawn.panels[1].pictures[0].top, drawn.panels[0].pictures[0].top);
    EXPECT_EQ(drawn.panels[3].pictures[0].left, drawn.panels[1].pictures[0].left);
    EXPECT_GT(drawn.panels[3].pictures[0].top, drawn.panels[1].pictures[0].top);
}

TEST(DrawFigures, RefusesHeadsThatDoNotFitAndCellsWithoutAMesh) {
    const TemporaryFolder folder;
    FigureRequest odd = balls({1, 2, 3}, true);
    odd.columns = {"a", "b"};
    EXPECT_THROW(draw_figures(std::vector{odd}, folder.path(), small_pictures), std::logic_error);
    FigureRequest empty = balls({1, 2, 3}, true);
    empty.panels[1].mesh = nullptr;
    EXPECT_THROW(draw_figures(std::vector{empty}, folder.path(), small_pictures), std::logic_error);
    FigureRequest framed = balls({1, 2}, true);
    framed.columns = {"a", "b"};
    framed.panels[0].mesh = nullptr;
    framed.frame_panel = 0;
    EXPECT_THROW(draw_figures(std::vector{framed}, folder.path(), small_pictures), std::logic_error);
}

// ---- a mesh before and after --------------------------------------------------------------------------------------------------------

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
    request.layout = Layout::one_frame;
    request.range = robust_range({request.panels.back()}, "viridis", "displacement", "%", 0);
    return request;
}

}   // namespace

TEST(DrawFigures, StatesOfAMeshAreFramedOnItsFirst) {
    FigureRequest request = balls({1, 1.5, 4, 3}, true);
    request.states = 2;
    const std::vector<PictureFrame> frames = three_quarter_frames(request, 200);
    EXPECT_EQ(frames[1].frame.pixels_per_unit, frames[0].frame.pixels_per_unit) << "one scale for both states";
    EXPECT_EQ(frames[3].frame.pixels_per_unit, frames[2].frame.pixels_per_unit);
    EXPECT_NEAR(frames[0].frame.pixels_per_unit / frames[2].frame.pixels_per_unit, 4, 1e-9) << "each mesh fills its frame";
}

// A bowl that turns its back is seen from behind where it is the first of its row, and so is what it is compared with.
TEST(DrawFigures, ComparedMeshesAreSeenFromOneSide) {
    TriangleMesh bowl = icosphere(4);
    std::vector<int> kept;
    for (int t = 0; t < bowl.F.rows(); ++t)
        if (bowl.X.row(bowl.F(t, 0)).z() < -0.4) kept.push_back(t);
    bowl.F = Faces(bowl.F(kept, Eigen::all));
    FigureRequest request = balls({1, 1, 1, 1}, true);
    request.panels[0].mesh = request.panels[3].mesh = std::make_shared<const TriangleMesh>(bowl);
    const double usual = render::three_quarter_view().from.z;
    const auto turned = [&] {
        std::vector<bool> backs;
        for (const PictureFrame& frame : three_quarter_frames(request, 100)) backs.push_back(frame.view.from.z != usual);
        return backs;
    };
    EXPECT_EQ(turned(), (std::vector<bool>{true, true, true, true}));
    request.states = 2;
    EXPECT_EQ(turned(), (std::vector<bool>{true, true, false, false}));
}

TEST(DrawFigures, CoarseEdgesAreDrawnOnCoarseMeshesOnly) {
    FigureRequest request = balls({1, 1}, false);   // 320 triangles each
    request.panels[1] = panel_of(icosphere(5), "q4_fine_ball", true);
    const auto plain = files_of(request);
    request.coarse_edges = true;
    const auto edged = files_of(request);
    EXPECT_NE(edged[0], plain[0]);
    EXPECT_EQ(edged[1], plain[1]);
}

TEST(DrawFigures, CoarsePlainMeshesShowTheirEdgesInMultiples) {
    const TemporaryFolder folder;
    FigureRequest request = shrunk_ball();
    const auto drawn = draw_figures(std::vector{request}, folder.path(), small_pictures).at("q5_pair");
    request.edges = true;
    const auto with = draw_figures(std::vector{request}, folder.path(), small_pictures).at("q5_pair");
    for (const std::size_t plain : {0u, 1u}) EXPECT_EQ(drawn.panels[plain].pictures[0].jpeg, with.panels[plain].pictures[0].jpeg);
    EXPECT_NE(drawn.panels[2].pictures[0].jpeg, with.panels[2].pictures[0].jpeg) << "colours are not drawn over unless it is asked for";
}
