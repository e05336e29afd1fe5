// What commands and the Python module share: tables, pictures and the object that `inspect --json` prints.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"
#include "mesh/small_meshes.h"
#include "run/one_mesh/curvature_columns.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/inspection.h"
#include "run/one_mesh/mesh_pictures.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

PreparedMesh prepared_tetrahedron() { return prepare_mesh({meshfolio::testing::tetrahedron(), "m.obj", {}, {}}); }

}   // namespace

TEST(OneMesh, DiffersFromItselfInNothing) {
    const TriangleMesh mesh = meshfolio::testing::tetrahedron();
    const auto lines = difference_lines(mesh, mesh);
    for (const DifferenceLine& line : lines) {
        const std::string key = line.key;
        if (key == "box_diagonal") continue;
        EXPECT_NEAR(line.value, key.ends_with("_ratio") ? 1 : 0, 1e-7) << key;
    }
    EXPECT_STREQ(lines.back().key, "inverted_faces");
}

TEST(OneMesh, HasAColumnForEachCurvatureAskedFor) {
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

TEST(OneMesh, IsInspectedAndItsProgressMayEndThat) {
    std::vector<std::string> told;
    const Inspection inspection =
        inspect_mesh(prepared_tetrahedron(), OperatorKind::cotan, [&](std::string_view what) { told.emplace_back(what); });
    const auto json = nlohmann::json::parse(inspection_json(inspection));
    EXPECT_EQ(json.at("euler_characteristic"), 2);
    EXPECT_GT(json.at("lambda_crit").get<double>(), 0);
    EXPECT_LE(json.at("lambda_crit_proved").at(0), json.at("lambda_crit_proved").at(1));
    EXPECT_TRUE(json.at("lambda_crit_with_zero_area_faces").is_null());
    EXPECT_FALSE(told.empty());
    struct Enough {};
    EXPECT_THROW(inspect_mesh(prepared_tetrahedron(), OperatorKind::cotan, [](std::string_view) { throw Enough{}; }), Enough);
}

TEST(OneMesh, IsDrawnFromEverySideThatIsNamed) {
    const PreparedMesh mesh = prepared_tetrahedron();
    PictureRequest request{.views = views_named(""), .range = std::pair{-1.0, 1.0}};
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
}

TEST(OneMesh, RefusesRangesThatNoColourBarCanPrint) {
    EXPECT_EQ(value_limits(-1, 2, "range"), std::pair(-1.0, 2.0));
    for (const auto& [low, high] : {std::pair{1.0, 1.0}, {2.0, 1.0}, {std::nan(""), 1.0}, {0.0, 1e101}, {0.0, 1e-101}})
        EXPECT_THROW(value_limits(low, high, "range"), UsageError) << low << " " << high;
}
