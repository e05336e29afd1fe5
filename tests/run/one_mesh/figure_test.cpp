// Figures of one's own: sizes, arrangement, shared ranges, and the same pictures as single views.
#include "run/one_mesh/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "base/errors.h"
#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;
using namespace meshfolio::run;
using render::Drawing;

namespace {

PreparedMesh prepared(const std::string& sample, const std::string& file, double scale = 1) {
    TriangleMesh mesh = make_sample(sample, 0);
    mesh.X *= scale;
    return prepare_mesh({mesh, file, {}, {}});
}

std::vector<FigureMesh> labelled(std::span<const PreparedMesh> meshes, const std::vector<std::string>& fields) {
    return figure_meshes(meshes, labels_of(meshes), fields);
}

template <class Item> std::vector<Item> items(const Drawing& drawing) {
    std::vector<Item> found;
    for (const Drawing::Item& item : drawing.items)
        if (const Item* one = std::get_if<Item>(&item)) found.push_back(*one);
    return found;
}

int count(const Drawing& drawing, const std::string& text) {
    const std::vector<Drawing::Text> texts = items<Drawing::Text>(drawing);
    return static_cast<int>(std::ranges::count(texts, text, &Drawing::Text::text));
}

double covered(const render::Image& picture) {
    return static_cast<double>(std::ranges::count_if(picture.pixels, [](render::Rgba p) { return p != render::Rgba{255, 255, 255, 255}; }));
}

class OwnFigure : public ::testing::Test {
protected:
    const std::vector<PreparedMesh> meshes_{prepared("sphere", "a/sphere.obj"), prepared("sphere", "half.obj", 0.5),
                                            prepared("torus", "b/sphere.obj")};
    const std::vector<FigureMesh> figure_ = labelled(meshes_, {"h-cotan", "gauss"});
};

}   // namespace

TEST_F(OwnFigure, HasTheRequestedWidthAndABarAndARangeForEachField) {
    for (const double mm : {85.0, 170.0}) {
        for (const double dpi : {72.0, 150.0}) {
            const Drawing drawing = figure_of(figure_, {.width = mm, .resolution = dpi});
            EXPECT_EQ(drawing.width, std::lround(mm / 25.4 * dpi));
            EXPECT_EQ(items<Drawing::Picture>(drawing).size(), 6U);
            EXPECT_EQ(items<Drawing::Ramp>(drawing).size(), 2U);
            for (const Drawing::Picture& picture : items<Drawing::Picture>(drawing)) {
                EXPECT_GE(picture.left, 0);
                EXPECT_LE(picture.left + picture.image->width, drawing.width);
                EXPECT_LE(picture.top + picture.image->height, drawing.height);
            }
        }
    }
    EXPECT_TRUE(items<Drawing::Ramp>(figure_of(figure_, {.width = 85, .resolution = 72, .bars = false})).empty());
}

TEST_F(OwnFigure, NamesMeshesByTheirFilesAndTellsEqualNamesApart) {
    const Drawing drawing = figure_of(figure_, {.width = 170, .resolution = 72, .title = "Three meshes"});
    for (const char* name : {"half.obj", "a/sphere.obj", "b/sphere.obj"}) EXPECT_EQ(count(drawing, name), 2) << name << ", for each field";
    EXPECT_EQ(count(drawing, "Three meshes"), 1);
    EXPECT_EQ(count(figure_of(std::span(figure_).first(1), {.width = 85, .resolution = 72}), "a/sphere.obj"), 0)
        << "a single mesh needs no label";
    EXPECT_EQ(count(figure_of(std::span(figure_).first(1), {.width = 85, .resolution = 72, .labels_single = true}), "a/sphere.obj"), 2);
}

TEST_F(OwnFigure, FillsEachPictureOrKeepsSizes) {
    const auto areas = [&](bool common) {
        const Drawing drawing =
            figure_of(std::span(figure_).first(2), {.views = {"+z"}, .common_fit = common, .width = 60, .resolution = 100});
        const std::vector<Drawing::Picture> pictures = items<Drawing::Picture>(drawing);
        return std::pair(covered(*pictures[0].image), covered(*pictures[1].image));
    };
    const auto [each, half_each] = areas(false);
    EXPECT_NEAR(half_each / each, 1, 0.03);
    const auto [common, half_common] = areas(true);
    EXPECT_NEAR(half_common / common, 0.25, 0.02);
}

TEST_F(OwnFigure, ShowsOneMeshFromAllSidesAtOneScale) {
    const std::vector<PreparedMesh> flat{prepared("sphere", "flat.obj")};
    std::vector<PreparedMesh> squashed = flat;
    squashed[0].mesh.X.col(2) *= 0.25;
    const Drawing drawing = figure_of(labelled(squashed, {"none"}), {.views = {"+x", "+z"}, .width = 80, .resolution = 100});
    const std::vector<Drawing::Picture> pictures = items<Drawing::Picture>(drawing);
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_NEAR(covered(*pictures[0].image) / covered(*pictures[1].image), 0.25, 0.02) << "an ellipse of axes 1 and 1/4 beside a disk";
    EXPECT_EQ(count(drawing, "+x"), 1);
}

TEST_F(OwnFigure, TakesItsColumns) {
    const auto places = [&](int columns, std::size_t fields) {
        std::vector<FigureMesh> figure = figure_;
        for (FigureMesh& mesh : figure) mesh.fields.resize(fields);
        std::set<int> lefts, tops;
        for (const Drawing::Picture& p : items<Drawing::Picture>(figure_of(figure, {.columns = columns, .width = 170, .resolution = 72})))
            lefts.insert(p.left), tops.insert(p.top);
        return std::pair(lefts.size(), tops.size());
    };
    EXPECT_EQ(places(0, 1), std::pair(std::size_t{3}, std::size_t{1}));
    EXPECT_EQ(places(1, 1), std::pair(std::size_t{1}, std::size_t{3}));
    EXPECT_EQ(places(3, 2), std::pair(std::size_t{3}, std::size_t{2}));
    EXPECT_EQ(places(6, 2), std::pair(std::size_t{6}, std::size_t{1})) << "both fields beside each other";
}

TEST_F(OwnFigure, IsTheSameTwiceAndHasIsolinesAsPaths) {
    const FigureStyle style{.sight = {.camera = render::Angles{20, 10}}, .width = 85, .resolution = 100, .isoline_spacing = 0.25};
    const std::vector<PreparedMesh> one{meshes_[0]};
    const std::vector<FigureMesh> figure = labelled(one, {"z"});
    for (const char* ending : {".svg", ".pdf", ".png"}) {
        const std::string bytes = encode_figure(figure, style, ending);
        EXPECT_EQ(bytes, encode_figure(figure, style, ending)) << ending;
        EXPECT_GT(bytes.size(), 1000U);
    }
    FigureStyle plain = style;
    plain.isoline_spacing = 0;
    EXPECT_GT(items<Drawing::Path>(figure_of(figure, style)).size(), items<Drawing::Path>(figure_of(figure, plain)).size() + 5);
}

TEST_F(OwnFigure, DistanceIsThatToTheFirstMesh) {
    const std::vector<FigureMesh> pair = labelled(std::span(meshes_).first(2), {"distance"});
    EXPECT_NEAR(pair[0].fields[0].values.maxCoeff(), 0.5, 0.02) << "between concentric spheres of radius 1 and 1/2";
    EXPECT_NEAR(pair[1].fields[0].values.minCoeff(), 0.5, 0.02);
    EXPECT_EQ(pair[0].fields[0].colormap, "pale");
    EXPECT_THROW(labelled(std::span(meshes_).first(1), {"distance"}), UsageError);
    EXPECT_THROW(labelled(meshes_, {"height"}), UsageError);
}

TEST_F(OwnFigure, RefusesFieldsThatItDoesNotDraw) {
    require_figure_fields({"none", "distance", "h-cotan"});
    for (const std::vector<std::string>& names : {std::vector<std::string>{}, {""}, {"", ""}, {"id"}, {"x", "id"}, {"height"}})
        EXPECT_THROW(require_figure_fields(names), UsageError) << names.size();
}

TEST_F(OwnFigure, TellsTheThreeQuarterViewFromTheCamera) {
    const std::vector<FigureMesh> one = labelled(std::span(meshes_).subspan(2), {"none"});
    const auto pictures = [&](std::vector<std::string> views, bool common, bool with_camera = true) {
        FigureStyle style{.views = std::move(views), .common_fit = common, .width = 85, .resolution = 72};
        if (with_camera) style.sight.camera = render::Angles{90, 0};
        return items<Drawing::Picture>(figure_of(one, style));
    };
    for (const bool common : {false, true}) {
        const std::vector<Drawing::Picture> three = pictures({"+x", "hero", "camera"}, common);
        const std::vector<Drawing::Picture> usual = pictures({"+x", "hero", "hero"}, common, false);
        ASSERT_EQ(three.size(), 3U);
        EXPECT_EQ(three[0].image->pixels, three[2].image->pixels) << "90° to the right of +z is +x";
        EXPECT_NE(three[1].image->pixels, three[2].image->pixels);
        EXPECT_EQ(three[1].image->pixels, usual[1].image->pixels);
    }
    EXPECT_EQ(pictures({}, false)[0].image->pixels, pictures({"camera"}, false)[0].image->pixels);
    EXPECT_NE(pictures({"hero"}, false)[0].image->pixels, pictures({"camera"}, false)[0].image->pixels);
}

TEST_F(OwnFigure, BreaksLinesBetweenViews) {
    const auto lines = [&](int columns) {   // numbers of pictures
        const Drawing drawing =
            figure_of(labelled(meshes_, {"none"}), {.views = {"+x", "+z"}, .columns = columns, .width = 170, .resolution = 72});
        std::map<int, int> count;
        for (const Drawing::Picture& picture : items<Drawing::Picture>(drawing)) ++count[picture.top];
        std::vector<int> counts;
        for (const auto& [top, pictures] : count) counts.push_back(pictures);
        return counts;
    };
    using Lines = std::vector<int>;
    EXPECT_EQ(lines(1), Lines(6, 1));
    EXPECT_EQ(lines(2), (Lines{2, 1, 2, 1}));
    EXPECT_EQ(lines(3), (Lines{3, 3}));
    EXPECT_EQ(lines(4), (Lines{3, 3}));
    EXPECT_EQ(lines(6), Lines{6});
}

TEST_F(OwnFigure, RefusesPicturesThatCannotBe) {
    EXPECT_THROW(figure_of(figure_, {.columns = 1, .width = 2000, .resolution = 2400}), UsageError);
    EXPECT_THROW(figure_of(figure_, {.width = 10, .resolution = 36}), UsageError);
    EXPECT_THROW(figure_of(figure_, {.width = 85, .isoline_spacing = 1e-6}), UsageError);
}
