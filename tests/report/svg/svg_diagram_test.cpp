#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "report/sample_document.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

Diagram diagram_of(Diagram::Path path, std::vector<Diagram::Label> labels = {}) {
    return {"d", "caption", "what is seen", {{"panel", {std::move(path)}, std::move(labels)}}};
}

double height_of(const std::string& svg) { return std::stod(matches(svg, "viewBox=\"0 0 640 ([0-9.]+)\"").at(0)); }

/// The points of all paths of a drawing.
std::vector<std::pair<double, double>> points_of(const std::string& svg) {
    const auto x = matches(svg, "[ML](-?[0-9.]+) -?[0-9.]+"), y = matches(svg, "[ML]-?[0-9.]+ (-?[0-9.]+)");
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(std::stod(x[i]), std::stod(y[i]));
    return points;
}

/// No coordinate is NaN, infinite or outside the picture.
void expect_sane(const Diagram& diagram) {
    const std::string svg = svg_of(diagram);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    const double height = height_of(svg);
    EXPECT_LT(height, 420);
    for (const auto& [x, y] : points_of(svg)) {
        EXPECT_GE(x, 0);
        EXPECT_LE(x, 640);
        EXPECT_GE(y, 0);
        EXPECT_LE(y, height);
    }
    for (const std::string& x : matches(svg, "<(?:text x|circle cx)=\"([^\"]*)\"")) {
        EXPECT_GE(std::stod(x), 0);
        EXPECT_LE(std::stod(x), 640);
    }
    for (const std::string& y : matches(svg, "<(?:text|circle)[^>]* c?y=\"([^\"]*)\"")) {
        EXPECT_GE(std::stod(y), 0);
        EXPECT_LE(std::stod(y), height);
    }
}

TEST(SvgDiagram, IsValidForAnyData) {
    expect_sane({"d", "", "", {}});
    expect_sane({"d", "", "", {{}, {}}});
    expect_sane(diagram_of(path_through({{1e-90, 1}}, Diagram::Style::line)));
    expect_sane(diagram_of(path_through({{0, 0}, {1e90, 3}}, Diagram::Style::accent)));
    expect_sane(diagram_of(path_through({{0, 0}, {1e-90, 0}}, Diagram::Style::accent_area, true)));
    expect_sane(diagram_of(path_through({{0, undefined}, {INFINITY, 1}, {1e300, 2}}, Diagram::Style::area, true)));
    expect_sane(
        diagram_of(path_through({{0, 0}, {1, 1}}, Diagram::Style::line), {{undefined, 0, text("nowhere")}, {1e200, 0, text("far")}}));
    expect_sane(diagram_of({}, {{3, 3, text("a point alone"), Diagram::Side::right, true}}));
    for (const int side : {0, 1, 2, 3, 4, 5, 6, 7, 8}) {
        expect_sane(diagram_of(
            path_through({{0, 0}, {1, 0}}, Diagram::Style::line),
            {{0, 0, text("a label"), static_cast<Diagram::Side>(side)}, {1, 0, text("another"), static_cast<Diagram::Side>(side), true}}));
    }
    for (const Document& document : {sample_document(), hostile_document()}) {
        for (const Block& block : document.sections[0].blocks) {
            if (const auto* diagram = std::get_if<Diagram>(&block)) expect_sane(*diagram);
        }
    }
}

// A right angle is drawn as one, whatever the panel's shape.
TEST(SvgDiagram, BothAxesHaveOneScale) {
    for (const double stretch : {0.01, 1.0, 50.0}) {
        const auto points = points_of(svg_of(diagram_of(path_through({{0, 0}, {stretch, 0}, {stretch, stretch}}, Diagram::Style::line))));
        ASSERT_EQ(points.size(), 3u);
        EXPECT_NEAR(points[1].first - points[0].first, points[1].second - points[2].second, 0.2);
        EXPECT_NEAR(points[0].second, points[1].second, 0.01);
        EXPECT_LT(points[2].second, points[1].second) << "y points upwards";
    }
}

TEST(SvgDiagram, EqualPanelsHaveEqualScalesAndStandSideBySide) {
    const Diagram::Panel panel{"", {path_through({{0, 0}, {2, 1}}, Diagram::Style::line)}, {}};
    const auto points = points_of(svg_of(Diagram{"d", "", "", {panel, panel, panel}}));
    ASSERT_EQ(points.size(), 6u);
    for (const std::size_t i : {2u, 4u}) {
        EXPECT_NEAR(points[i + 1].first - points[i].first, points[1].first - points[0].first, 0.2);
        EXPECT_GT(points[i].first, points[i - 1].first);
        EXPECT_NEAR(points[i].second, points[0].second, 0.1);
    }
}

TEST(SvgDiagram, MathematicsIsSet) {
    const std::string svg = svg_of(diagram_of(path_through({{0, 0}, {1, 1}}, Diagram::Style::line), {{0, 0, text("at ", math("α_ij^2"))}}));
    EXPECT_NE(svg.find(">at <tspan font-style=\"italic\">α</tspan><tspan dy=\"3.5\" font-size=\"11\">ij</tspan><tspan dy=\"-8\" "
                       "font-size=\"11\">2</tspan></text>"),
              std::string::npos)
        << svg;
}

TEST(SvgDiagram, AnArcGoesTheShortWayAtItsRadius) {
    const double pi = std::numbers::pi;
    for (double direction = 0; direction < 2 * pi; direction += 0.3) {
        const DiagramPoint vertex{3, -2}, a{3 + std::cos(direction), -2 + std::sin(direction)},
            b{3 + 5 * std::cos(direction + 2), -2 + 5 * std::sin(direction + 2)};
        for (const auto& path :
             {angle_arc(vertex, a, b, 0.5, Diagram::Style::accent), angle_arc(vertex, b, a, 0.5, Diagram::Style::accent)}) {
            double length = 0;
            for (std::size_t i = 0; i < path.x.size(); ++i) {
                EXPECT_NEAR(std::hypot(path.x[i] - 3, path.y[i] + 2), 0.5, 1e-12);
                if (i > 0) length += std::hypot(path.x[i] - path.x[i - 1], path.y[i] - path.y[i - 1]);
            }
            EXPECT_NEAR(length, 2 * 0.5, 0.01);
        }
        const DiagramPoint middle = inside_angle(vertex, a, b, 2);
        EXPECT_NEAR(middle[0], 3 + 2 * std::cos(direction + 1), 1e-12);
        EXPECT_NEAR(middle[1], -2 + 2 * std::sin(direction + 1), 1e-12);
    }
}

}   // namespace
}   // namespace meshfolio::report
