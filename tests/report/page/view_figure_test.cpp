#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/page/view_blocks.h"

namespace meshfolio::report {
namespace {

using nlohmann::json;

/// Returns a figure of meshes with square pictures, `large` pixels wide from three quarters and `small` for the six views.
DrawnFigure six_views_of(std::size_t panels, int large, int small) {
    DrawnFigure drawn{.sheet = "images/q1_sheet.png"};
    for (std::size_t p = 0; p < panels; ++p) {
        DrawnPanel& panel = drawn.panels.emplace_back();
        panel.label = "mesh " + std::to_string(p);
        panel.pictures.push_back({"", 0, 0, large, large});
        for (const char* view : {"+x", "+y", "+z", "-x", "-y", "-z"}) panel.pictures.push_back({view, 0, 0, small, small});
    }
    return drawn;
}

json view_of(const DrawnFigure& drawn) {
    Document document;
    document.sections.resize(1);
    document.sections[0].id = "q1";
    const Figure figure{"q1_h", "Caption", "Alt"};
    document.sections[0].blocks = {figure};
    const Numbering numbering(document, {});
    const DrawnFigures figures{{"q1_h", drawn}};
    json view = json::object();
    enter_pictures(view, figure, drawn, {figures, numbering, {}, {}});
    return view;
}

/// Returns the width of one of the six views in a figure of this width.
double view_width(const json& block, int large, int small, double figure_width) {
    const auto in_a_line = static_cast<double>(block["view_lines"][0]["views"].size());
    return std::stoi(block["tenths"].get<std::string>()) / 10.0 * figure_width * small / (large + in_a_line * small);
}

// 174 mm wide are the figures of the paper, 1016 pixels those of the page; gaps take 8 % at most.
TEST(ViewFigure, TheSixViewsAreLargeEnoughToBeSeen) {
    for (const auto& [panels, large, small] : {std::tuple{1, 600, 270}, {2, 216, 216}, {6, 216, 216}, {3, 216, 200}}) {
        const json view = view_of(six_views_of(static_cast<std::size_t>(panels), large, small));
        ASSERT_EQ(view["blocks"].size(), static_cast<std::size_t>(panels));
        for (const json& block : view["blocks"]) {
            EXPECT_GE(0.92 * view_width(block, large, small, 174), 22) << panels;
            EXPECT_GE(0.92 * view_width(block, large, small, 1016), 130) << panels;
        }
    }
}

TEST(ViewFigure, DirectionsHaveAMinusAndFlatMeshesOnePicture) {
    DrawnFigure drawn = six_views_of(2, 216, 216);
    drawn.panels[1].pictures = {{"-z", 0, 0, 216, 216}};
    drawn.states = 2;
    const json blocks = view_of(drawn)["blocks"];
    EXPECT_EQ(blocks[0]["view_lines"][0]["views"][3]["view"], "\u2212x");
    EXPECT_EQ(blocks[0]["is_flat"], false);
    EXPECT_EQ(blocks[1]["is_flat"], true);
    EXPECT_TRUE(blocks[1]["view_lines"].empty());
    EXPECT_EQ(blocks[0]["is_further"], false);
    EXPECT_EQ(blocks[1]["is_further"], true) << "the second of a pair";
}

// Numbers with their unit at both ends of every bar, and colours without steps between them.
TEST(ViewFigure, APanelWithColoursOfItsOwnHasABar) {
    DrawnFigure drawn = six_views_of(2, 216, 216);
    Legend legend{"H", "% of area", -7.21, 7.21, {"#0000ff", "#ffffff", "#ff0000"}, 0, 0.028};
    drawn.panels[0].legend = legend;
    const json view = view_of(drawn);
    const std::string bar = view["blocks"][0]["bar"];
    for (const char* part :
         {">\u22127.21<", ">7.21\u00a0% of area, 2.8\u202f% beyond<", "<linearGradient id=\"colours-", "fill=\"url(#colours-"})
        EXPECT_NE(bar.find(part), std::string::npos) << part << "\n" << bar;
    EXPECT_EQ(view["blocks"][1]["bar"], "");
    EXPECT_EQ(view["has_legend"], false);
    drawn.legend = legend;
    EXPECT_NE(view_of(drawn)["legend"].get<std::string>().find("url(#colours-"), std::string::npos);
}

}   // namespace
}   // namespace meshfolio::report
