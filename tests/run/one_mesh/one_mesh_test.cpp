// Functions that commands and the Python module share: tables, pictures and the JSON of `inspect`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"
#include "geometry/measures/hausdorff.h"
#include "geometry/measures/mesh_error.h"
#include "mesh/small_meshes.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/inspection.h"
#include "run/one_mesh/mesh_pictures.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

PreparedMesh prepared_tetrahedron() { return prepare_mesh({meshfolio::testing::tetrahedron(), "m.obj", {}, {}}); }

}   // namespace

TEST(OneMesh, DiffersFromItselfByZero) {
    const TriangleMesh mesh = meshfolio::testing::tetrahedron();
    const Difference difference = difference_of(mesh, mesh);
    EXPECT_TRUE(difference.same_triangles);
    for (const DifferenceLine& line : difference.lines) {
        const std::string key = line.key;
        if (key == "box_diagonal") continue;
        EXPECT_NEAR(line.value, key.ends_with("_ratio") ? 1 : 0, 1e-7) << key;
        EXPECT_EQ(line.is_count, key == "inverted_faces");
    }
}

TEST(OneMesh, IsComparedVertexByVertexIfTheTrianglesAreTheSame) {
    const TriangleMesh a = meshfolio::testing::tetrahedron(), b{a.X.array() * 1.25 + 0.5, a.F};
    const MeshDifference by_vertices = compare_meshes(a, b);
    const auto json = nlohmann::json::parse(difference_json(difference_of(a, b)));
    EXPECT_EQ(json.at("rms"), by_vertices.rms);
    EXPECT_EQ(json.at("max"), by_vertices.max);
    EXPECT_EQ(json.at("hausdorff"), hausdorff_distance(a, b).distance);
    EXPECT_EQ(json.at("hausdorff_bound"), hausdorff_distance(a, b).bound);
    EXPECT_EQ(json.at("volume_ratio"), by_vertices.volume_ratio);
    EXPECT_EQ(json.at("same_triangles"), true);
    EXPECT_FALSE(json.contains("rms_a_to_b"));
    const auto surfaces = nlohmann::json::parse(difference_json(difference_of(a, b, true)));
    EXPECT_EQ(surfaces.at("same_triangles"), true);
    EXPECT_EQ(surfaces.at("histogram").at("a_to_b").size(), distance_bins);
    EXPECT_GE(surfaces.at("hausdorff_bound"), json.at("hausdorff"));
    EXPECT_GE(json.at("hausdorff_bound"), surfaces.at("hausdorff"));
    EXPECT_LT(surfaces.at("rms").get<double>(), json.at("rms").get<double>());
}

TEST(OneMesh, IsComparedAsASurfaceIfTheTrianglesDiffer) {
    const TriangleMesh a = meshfolio::testing::tetrahedron();
    TriangleMesh open = a;
    open.F.conservativeResize(3, 3);
    const auto json = nlohmann::json::parse(difference_json(difference_of(a, open)));
    EXPECT_EQ(json.at("same_triangles"), false);
    EXPECT_EQ(json.at("rms_b_to_a"), 0);
    EXPECT_EQ(json.at("rms"), json.at("rms_a_to_b"));
    EXPECT_GT(json.at("hausdorff"), 0);
    EXPECT_TRUE(json.at("volume_ratio").is_null());   // one is open
    EXPECT_FALSE(json.contains("inverted_faces"));
    EXPECT_THROW(difference_of(a, {a.X, Faces(0, 3)}), MeshError);
    EXPECT_FALSE(difference_of({a.X, Faces(0, 3)}, {a.X, Faces(0, 3)}).distances.has_value());
}

TEST(OneMesh, RefusesIsolinesThatWouldHideTheColours) {
    const PreparedMesh mesh = prepared_tetrahedron();
    const Field field = field_of(mesh, "x");
    const double width = field.values.maxCoeff() - field.values.minCoeff();
    PictureRequest request{.views = views_named("+z")};
    request.draw.width = request.draw.height = 200;
    request.draw.isoline_spacing = width / 10;   // some 18 pixels
    const MeshPictures drawn = draw_pictures(mesh, field, request);
    EXPECT_NE(drawn.sheet.color_bar->quantity.find("a line every "), std::string::npos) << drawn.sheet.color_bar->quantity;
    request.draw.isoline_spacing = width / 100;
    EXPECT_THROW(draw_pictures(mesh, field, request), UsageError);
}

TEST(OneMesh, LeavesOutDenseEdgesAndSaysSo) {
    const PreparedMesh mesh = prepared_tetrahedron();
    PictureRequest request{.views = views_named("+z")};
    request.draw.edges = true;
    const auto subtitle_at = [&](int side) {
        request.draw.width = request.draw.height = side;
        return draw_pictures(mesh, {}, request).sheet.subtitle;
    };
    EXPECT_EQ(subtitle_at(100).find("edges left out"), std::string::npos);
    EXPECT_NE(subtitle_at(2).find("edges left out"), std::string::npos) << subtitle_at(2);
}

TEST(OneMesh, HasAColumnForEachRequestedCurvature) {
    const PreparedMesh mesh = prepared_tetrahedron();
    const auto names = [&](OperatorKind kind, bool with_jets) {
        std::set<std::string> found;
        for (const VertexColumn& column : curvature_columns(mesh, AreaForm::barycentric, kind, with_jets)) {
            found.insert(column.name);
            EXPECT_EQ(column.values.size(), 4) << column.name;
        }
        return found;
    };
    EXPECT_EQ(names(OperatorKind::cotan, false), (std::set<std::string>{"area", "h_uniform", "k_gauss", "h_cotan", "h_uniform_scaled"}));
    EXPECT_TRUE(names(OperatorKind::cotan, true).contains("k_jet"));
    EXPECT_TRUE(names(OperatorKind::idt_original_mass, false).contains("h_idt_original_mass"));
}

TEST(OneMesh, InspectionStopsWhenProgressThrows) {
    std::vector<std::string> steps;
    const Inspection inspection =
        inspect_mesh(prepared_tetrahedron(), OperatorKind::cotan, [&](std::string_view what) { steps.emplace_back(what); });
    const auto json = nlohmann::json::parse(inspection_json(inspection));
    EXPECT_EQ(json.at("euler_characteristic"), 2);
    EXPECT_GT(json.at("lambda_crit").get<double>(), 0);
    EXPECT_LE(json.at("lambda_crit_proved").at(0), json.at("lambda_crit_proved").at(1));
    EXPECT_TRUE(json.at("lambda_crit_with_zero_area_faces").is_null());
    EXPECT_FALSE(steps.empty());
    struct Enough {};
    EXPECT_THROW(inspect_mesh(prepared_tetrahedron(), OperatorKind::cotan, [](std::string_view) { throw Enough{}; }), Enough);
}

// A triangle of joined vertices has no cotangents; a triangle of three vertices on a line has.
TEST(OneMesh, InspectionDistinguishesJoinedVerticesFromTrianglesOfZeroArea) {
    const auto inspected = [](const Vector3& last) {
        TriangleMesh mesh{Positions(5, 3), Faces(6, 3)};
        mesh.X << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1, last.transpose();
        mesh.F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 4, 0, 3, 4, 2, 4, 3;
        return inspect_mesh(prepare_mesh({mesh, "pair.obj", {}, {}}), OperatorKind::cotan, [](std::string_view) {});
    };
    const Inspection pair = inspected({-1, -1, 1}), line = inspected({0, 0, 1});
    EXPECT_EQ(pair.facts.counts.zero_area_faces, 2);
    EXPECT_EQ(pair.joined_vertices, 1);
    EXPECT_FALSE(pair.floored.has_value());
    EXPECT_EQ(line.facts.counts.zero_area_faces, 1);
    EXPECT_EQ(line.joined_vertices, 0);
    EXPECT_TRUE(line.floored.has_value());
}

TEST(OneMesh, IsDrawnFromEveryNamedSide) {
    const PreparedMesh mesh = prepared_tetrahedron();
    PictureRequest request{.views = views_named(""), .colors = {.range = std::pair{-1.0, 1.0}}};
    request.draw.width = request.draw.height = 10;
    const MeshPictures drawn = draw_pictures(mesh, field_of(mesh, "x"), request);
    EXPECT_EQ(drawn.sheet.view_names, (std::vector<std::string>{"+x", "-x", "+y", "-y", "+z", "-z"}));
    EXPECT_EQ(drawn.range->low, -1);
    const render::Image bare = composed(drawn.sheet, true);
    EXPECT_EQ(bare.width, 30);
    EXPECT_EQ(bare.height, 20);
    EXPECT_EQ(bare_sheet_pixels(6, request.draw), 600);
    EXPECT_FALSE(draw_pictures(mesh, field_of(mesh, "none"), request).range.has_value());
    EXPECT_THROW(views_named("+x,up"), UsageError);
    EXPECT_THROW(views_named("camera"), UsageError) << "there is none";
}

TEST(OneMesh, IsSeenFromTheCameraAndNearer) {
    const PreparedMesh mesh = prepared_tetrahedron();
    const auto drawn = [&](const std::string& views, const render::Sight& sight) {
        PictureRequest request{.views = views_named(views, sight), .sight = sight};
        request.draw.width = request.draw.height = 40;
        return draw_pictures(mesh, {}, request).sheet;
    };
    const auto covered = [](const render::Image& picture) {
        return static_cast<double>(std::ranges::count_if(picture.pixels, [](render::Rgba p) {
            return p != render::Rgba{255, 255, 255, 255};
        }));
    };
    const render::ContactSheet camera = drawn("", {.camera = render::Angles{90, 0}});
    ASSERT_EQ(camera.pictures.size(), 1U);
    EXPECT_EQ(camera.view_names, std::vector<std::string>{"azimuth 90°, elevation 0°"});
    EXPECT_EQ(camera.pictures[0].pixels, drawn("+x", {}).pictures[0].pixels) << "90° to the right of +z is +x";
    EXPECT_EQ(drawn("+x,camera", {.camera = render::Angles{0, 0}}).pictures.size(), 2U);
    EXPECT_NEAR(covered(drawn("+z", {.zoom = 0.5}).pictures[0]), covered(drawn("+z", {}).pictures[0]) / 4, 30);
    EXPECT_EQ(drawn("-y", {.up = render::Up::z}).pictures[0].pixels,
              drawn("", {.camera = render::Angles{0, 0}, .up = render::Up::z}).pictures[0].pixels);
}

TEST(OneMesh, RefusesRangesThatNoColourBarCanPrint) {
    EXPECT_EQ(value_limits("-1,2"), std::pair(-1.0, 2.0));
    for (const char* text : {"1,1", "2,1", "nan,1", "0,1e101", "0,1e-101", "", "1", ",", "1,", "1,2,3", "a,b"})
        EXPECT_THROW(value_limits(text), UsageError) << text;
}
