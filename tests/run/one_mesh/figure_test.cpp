// Figures of one's own: sizes, arrangement, shared ranges, and the same pictures as single views.
#include "run/one_mesh/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

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

std::vector<FigureMesh> figure_meshes(const std::vector<PreparedMesh>& meshes, const std::vector<std::string>& fields) {
    std::vector<FigureMesh> figure;
    for (const std::string& label : labels_of(meshes)) figure.push_back({label, meshes[figure.size()], {}});
    for (const std::string& name : fields)
        for (std::size_t i = 0; Field & field : std::vector<Field>(fields_of(meshes, name))) figure[i++].fields.push_back(std::move(field));
    return figure;
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
    const std::vector<FigureMesh> figure_ = figure_meshes(meshes_, {"h-cotan", "gauss"});
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
    const Drawing drawing = figure_of(figure_meshes(squashed, {"none"}), {.views = {"+x", "+z"}, .width = 80, .resolution = 100});
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
    const std::vector<FigureMesh> figure = figure_meshes(one, {"z"});
    for (const char* ending : {".svg", ".pdf", ".png"}) {
        const std::string bytes = encode_figure(figure_of(figure, style), 100, "z", ending);
        EXPECT_EQ(bytes, encode_figure(figure_of(figure, style), 100, "z", ending)) << ending;
        EXPECT_GT(bytes.size(), 1000U);
    }
    FigureStyle plain = style;
    plain.isoline_spacing = 0;
    EXPECT_GT(items<Drawing::Path>(figure_of(figure, style)).size(), items<Drawing::Path>(figure_of(figure, plain)).size() + 5);
}

TEST_F(OwnFigure, DistanceIsThatToTheFirstMesh) {
    const std::vector<Field> fields = fields_of(std::span(meshes_).first(2), "distance");
    EXPECT_NEAR(fields[0].values.maxCoeff(), 0.5, 0.02) << "between concentric spheres of radius 1 and 1/2";
    EXPECT_NEAR(fields[1].values.minCoeff(), 0.5, 0.02);
    EXPECT_EQ(fields[0].colormap, "pale");
    EXPECT_THROW(fields_of(std::span(meshes_).first(1), "distance"), UsageError);
    EXPECT_THROW(fields_of(meshes_, "height"), UsageError);
}

TEST_F(OwnFigure, RefusesPicturesThatCannotBe) {
    EXPECT_THROW(figure_of(figure_, {.columns = 1, .width = 2000, .resolution = 2400}), UsageError);
    EXPECT_THROW(figure_of(figure_, {.width = 10, .resolution = 36}), UsageError);
    EXPECT_THROW(figure_of(figure_, {.width = 85, .isoline_spacing = 1e-6}), UsageError);
}
