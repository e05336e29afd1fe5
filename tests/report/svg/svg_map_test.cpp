#include <gtest/gtest.h>

#include <cmath>

#include "report/sample_document.h"
#include "report/svg/map_scale.h"
#include "report/svg/plot_axis.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

Map map_of(std::vector<double> x, std::vector<double> y, std::vector<double> values) {
    Map map{"m", "caption", "what is seen", "λ [length²]", "iteration", "error [length]", std::move(x), std::move(y)};
    map.undefined = "blew up";
    map.panels = {{"explicit", std::move(values)}};
    return map;
}

/// Lightness of a colour as a grey printer sees it, 0 to 255.
double grey_of(const std::string& color) {
    const auto part = [&](std::size_t at) { return double(std::stoi(color.substr(at, 2), nullptr, 16)); };
    return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
}

TEST(Legend, NumbersOfALogarithmicScaleStandAtEqualRatios) {
    const std::string svg = svg_of(Legend{"distance", "%", 0.1, 10, {"#ffffff", "#000000"}, 0, 0, "", {}, true}, "place");
    const auto place = [&](const std::string& number) {
        const std::size_t end = svg.find(">" + number + "</text>"), start = svg.rfind("x=\"", end) + 3;
        return end == std::string::npos ? NAN : std::stod(svg.substr(start));
    };
    EXPECT_NEAR(place("1") - place("0.1"), place("10") - place("1"), 0.11) << svg;
    EXPECT_GT(place("1"), place("0.1"));
}

// ---- edges and colours ------------------------------------------------------------------------------------------------------

TEST(CellEdges, LieHalfWayBetweenCentresAndEquallyFarOutside) {
    EXPECT_EQ(cell_edges({1, 2, 4}, false), (std::vector<double>{0.5, 1.5, 3, 5}));
    const auto edges = cell_edges({1, 4, 16}, true);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(edges[i], 0.5 * std::pow(4, double(i)), 1e-12);
}

TEST(CellEdges, EncloseTheirCentres) {
    for (const bool log : {false, true}) {
        for (const std::vector<double>& centres : std::vector<std::vector<double>>{{3}, {1e-9, 1}, {1, 2, 3, 10, 1000}}) {
            const auto edges = cell_edges(centres, log);
            ASSERT_EQ(edges.size(), centres.size() + 1);
            for (std::size_t i = 0; i < centres.size(); ++i) {
                EXPECT_LT(edges[i], centres[i]);
                EXPECT_GT(edges[i + 1], centres[i]);
            }
        }
    }
}

TEST(CellEdges, AreEmptyIfTheAxisCannotShowTheCentres) {
    EXPECT_TRUE(cell_edges({}, false).empty());
    EXPECT_TRUE(cell_edges({2, 1}, false).empty());
    EXPECT_TRUE(cell_edges({1, 1}, false).empty());
    EXPECT_TRUE(cell_edges({1, undefined}, false).empty());
    EXPECT_TRUE(cell_edges({0, 1}, true).empty());
}

TEST(PlotAxis, ExactlyHasNoMargin) {
    const Axis axis = Axis::exactly(0.3, 700, true);
    EXPECT_EQ(axis.position(0.3), 0);
    EXPECT_NEAR(axis.position(700), 1, 1e-12);
    EXPECT_FALSE(axis.ticks().empty());
    EXPECT_LE(Axis::exactly(1e20, std::nextafter(1e20, 2e20), false).ticks().size(), 13u) << "a range too narrow for its numbers to differ";
    EXPECT_LT(Axis::exactly(5, 1, false).low(), Axis::exactly(5, 1, false).high());
    EXPECT_LT(0, Axis::exactly(-1, 1, true).low());
}

TEST(MapScale, BandsAscendFromEndToEnd) {
    Map map = map_of({1, 2}, {1, 2}, {1, 10, 100, 10000});
    for (const bool log : {false, true}) {
        map.log_values = log;
        const MapScale scale(map);
        EXPECT_EQ(scale.low(), 1);
        EXPECT_EQ(scale.high(), 10000);
        EXPECT_EQ(scale.band(1), 0);
        EXPECT_EQ(scale.band(10000), MapScale::bands - 1);
        EXPECT_EQ(scale.band(100) == MapScale::bands / 2, log);
    }
}

TEST(MapScale, SequentialColoursDescendInGrey) {
    const MapScale scale(map_of({1}, {1}, {1}));
    for (int band = 1; band < MapScale::bands; ++band) EXPECT_LT(grey_of(scale.color(band)), grey_of(scale.color(band - 1)) - 2) << band;
}

TEST(MapScale, DivergesEvenlyFromItsMiddle) {
    Map map = map_of({1, 2}, {1, 2}, {0.5, 0.9, 1, 3});
    map.colours = Map::Colours::diverging;
    map.middle = 1;
    const MapScale linear(map);
    EXPECT_EQ(linear.low(), -1);
    EXPECT_EQ(linear.high(), 3);
    EXPECT_LT(linear.band(0.9999), MapScale::bands / 2);
    EXPECT_GE(linear.band(1.0001), MapScale::bands / 2);
    map.log_values = true;
    EXPECT_NEAR(MapScale(map).low(), 1.0 / 3, 1e-12);
    for (int band = 0; band < MapScale::bands / 2; ++band)
        EXPECT_NEAR(grey_of(linear.color(band)), grey_of(linear.color(MapScale::bands - 1 - band)), 12) << band;
}

TEST(MapScale, ValuesBeyondTheRangeAreClippedAndReported) {
    Map map = map_of({1, 2}, {1, 2}, {-5, 0.5, 1, undefined});
    map.range = {0, 1};
    const MapScale scale(map);
    EXPECT_TRUE(scale.clips_below());
    EXPECT_FALSE(scale.clips_above());
    EXPECT_EQ(scale.band(-5), 0);
    EXPECT_EQ(scale.band(1e300), MapScale::bands - 1);
    EXPECT_EQ(count_of(svg_of(map), "L") - count_of(svg_of(map_of({1, 2}, {1, 2}, {-5, 0.5, 1, undefined})), "L"), 2u);   // one tip
}

// ---- the drawing ----------------------------------------------------------------------------------------------------------

void expect_sane(const Map& map) {
    const std::string svg = svg_of(map);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    const double height = std::stod(matches(svg, "viewBox=\"0 0 640 ([0-9.]+)\"").at(0));
    for (const std::string& x : matches(svg, "<(?:text|rect|circle|line) (?:x|x1|cx)=\"([^\"]*)\"")) {
        EXPECT_GE(std::stod(x), 0);
        EXPECT_LE(std::stod(x), 640);
    }
    for (const std::string& y : matches(svg, " (?:y|y1|cy)=\"([^\"]*)\"")) {
        EXPECT_GE(std::stod(y), 0);
        EXPECT_LE(std::stod(y), height);
    }
}

TEST(SvgMap, IsValidForAnyData) {
    for (const auto colours : {Map::Colours::sequential, Map::Colours::diverging}) {
        for (const bool log : {false, true}) {
            for (const std::vector<double>& values : std::vector<std::vector<double>>{
                     {}, {1}, {1, 2, 3, 4}, {0, 0, 0, 0}, {undefined, undefined, undefined, undefined}, {1, INFINITY, -1, 1e300}}) {
                Map map = map_of({1, 2}, {1, 10}, values);
                map.log_x = map.log_y = map.log_values = log;
                map.colours = colours;
                map.middle = 1;
                expect_sane(map);
            }
        }
    }
    expect_sane(map_of({}, {}, {}));
    expect_sane(map_of({2, 1}, {1}, {1, 2}));
    Map none = map_of({1}, {1}, {1});
    none.panels.clear();
    expect_sane(none);
    const Document sample = sample_document();
    for (const Block& block : sample.sections[0].blocks) {
        if (const auto* map = std::get_if<Map>(&block)) expect_sane(*map);
    }
}

TEST(SvgMap, IsWellFormedWithHostileNames) {
    if (!has_program("xmllint")) GTEST_SKIP() << "xmllint is not installed";
    const TemporaryFolder folder;
    const Document hostile_names = hostile_document();
    for (const Block& block : hostile_names.sections[0].blocks) {
        const auto* map = std::get_if<Map>(&block);
        if (!map) continue;
        for (const std::string& svg : {svg_of(*map), svg_on_white(svg_of(*map))})
            EXPECT_TRUE(succeeds("xmllint --noout '" + folder.write("map.svg", svg).string() + "'"));
    }
}

TEST(SvgMap, CellsOfOneBandAreOneRectangle) {
    const auto rectangles = [](std::vector<double> values) {
        std::size_t count = 0;
        for (const std::string& path : matches(svg_of(map_of({1, 2, 3, 4}, {1}, std::move(values))), "<path d=\"([^\"]*)\" fill=\"#"))
            count += count_of(path, "M");
        return count;
    };
    EXPECT_EQ(rectangles({1, 1, 5, 5}), 2u);
    EXPECT_EQ(rectangles({1, 5, 1, 5}), 4u);
    EXPECT_EQ(rectangles({1, 1, undefined, 5}), 2u);
}

TEST(SvgMap, CellsLieWhereTheirValuesAre) {
    // The value at the right end of the first row is the largest: its cell is at the lower right.
    const std::string svg = svg_of(map_of({1, 2, 3}, {1, 2}, {0, 0, 9, 0, 0, 0}));
    const auto largest = matches(svg, "<path d=\"M([0-9.]+) ([0-9.]+)H[^\"]*\" fill=\"#253261\"");
    ASSERT_EQ(largest.size(), 1u);
    const std::string frame = matches(svg, "<rect (x=[^/]*) fill=\"none\"").at(0);
    const double left = std::stod(matches(frame, "x=\"([0-9.]+)\"").at(0)), across = std::stod(matches(frame, "width=\"([0-9.]+)\"").at(0)),
                 top = std::stod(matches(frame, "y=\"([0-9.]+)\"").at(0)), down = std::stod(matches(frame, "height=\"([0-9.]+)\"").at(0));
    const std::string corner = matches(svg, "<path d=\"M([0-9.]+ [0-9.]+)H[^\"]*\" fill=\"#253261\"").at(0);
    EXPECT_NEAR(std::stod(corner), left + across * 2 / 3, 0.2);
    EXPECT_NEAR(std::stod(corner.substr(corner.find(' '))), top + down / 2, 0.2);
    const std::string right = matches(svg, "<path d=\"M[0-9. ]+H[0-9.]+V([0-9.]+)H[^\"]*\" fill=\"#253261\"").at(0);
    EXPECT_NEAR(std::stod(right), top + down, 0.2) << "rows go up";
}

TEST(SvgMap, UndefinedCellsAreHatchedAndNamed) {
    const std::string with = svg_of(map_of({1, 2}, {1}, {1, undefined})), without = svg_of(map_of({1, 2}, {1}, {1, 2}));
    EXPECT_NE(with.find("<pattern id=\"m-hatch\""), std::string::npos);
    EXPECT_EQ(count_of(with, "fill=\"url(#m-hatch)\""), 2u);   // the cell and the legend
    EXPECT_NE(with.find(">blew up<"), std::string::npos);
    EXPECT_EQ(without.find("hatch"), std::string::npos);
    EXPECT_EQ(without.find("blew up"), std::string::npos);
}

TEST(SvgMap, TheMiddleIsALineBetweenItsSides) {
    Map map = map_of({1, 2, 3}, {1}, {-1, 1, 1});
    const std::string line = "fill=\"none\" stroke=\"#1b1b1f\" stroke-width=\"0.9\"";
    EXPECT_EQ(count_of(svg_of(map), line), 0u);
    map.colours = Map::Colours::diverging;
    EXPECT_EQ(count_of(svg_of(map), line), 1u);
    map.panels[0].values = {2, 1, 1};
    EXPECT_EQ(count_of(svg_of(map), line), 0u);
}

TEST(MapScale, TheTwoSidesOfTheMiddleDiffer) {
    Map map = map_of({1, 2}, {1}, {-1, 1});
    map.colours = Map::Colours::diverging;
    const MapScale scale(map);
    const auto blueness = [&](int band) {   // of "#rrggbb"
        const std::string c = scale.color(band);
        return std::stoi(c.substr(5, 2), nullptr, 16) - std::stoi(c.substr(1, 2), nullptr, 16);
    };
    EXPECT_GE(blueness(MapScale::bands / 2 - 1), 20);
    EXPECT_LE(blueness(MapScale::bands / 2), -20);
}

TEST(SvgMap, TitlesOfPanelsDoNotMeetThoseOfTheAxes) {
    Map map = map_of({1, 2}, {1}, {1, 2});
    map.value_label = "a quantity with a long name";
    map.panels[0].title = "a panel";
    const std::string svg = svg_of(map);
    const auto height_of = [&](const std::string& words) {
        return std::stod(matches(svg, "<text[^>]* y=\"([0-9.]+)\"[^>]*>" + words + "<").at(0));
    };
    EXPECT_GE(height_of("a panel") - height_of("colour: a quantity with a long name"), 19) << "more than a line";
}

TEST(SvgMap, LinesStayInsideAndLettersAreThere) {
    Map map = map_of({1, 2, 3}, {1, 2}, {1, 2, 3, 4, 5, 6});
    map.panels.push_back(map.panels[0]);
    for (Map::Panel& panel : map.panels) panel.lines = {{"limit", {1, 2, 99, 2.5, 3}, {1, 1.5, 1.5, 1.5, 2}}};
    map.panels[0].markers = {{2, 1, "a"}, {50, 1, "b"}};
    const std::string svg = svg_of(map);
    EXPECT_EQ(count_of(svg, ">limit<"), 1u);   // once for both panels
    EXPECT_NE(svg.find(">a<"), std::string::npos);
    EXPECT_EQ(svg.find(">b<"), std::string::npos);   // outside
    const auto lines = matches(svg, "<path d=\"([^\"]*)\" fill=\"none\" stroke-linejoin=\"round\" stroke=\"#1b1b1f\"");
    ASSERT_EQ(lines.size(), 3u);              // the legend's first
    EXPECT_EQ(count_of(lines[1], "M"), 2u);   // broken where it leaves
}

TEST(SvgMap, HasATitleAndADescription) {
    const std::string svg = svg_of(map_of({1, 2}, {1}, {1, 2}));
    EXPECT_NE(svg.find("role=\"img\""), std::string::npos);
    EXPECT_NE(svg.find("<desc id=\"m-desc\">what is seen</desc>"), std::string::npos);
    EXPECT_NE(svg.find("error [length] over λ [length²] and iteration"), std::string::npos);
    EXPECT_EQ(svg.find(" style=\""), std::string::npos);
    EXPECT_NE(svg_on_white(svg_of(map_of({1}, {1}, {1}))).find("<?xml"), std::string::npos);
}

}   // namespace
}   // namespace meshfolio::report
