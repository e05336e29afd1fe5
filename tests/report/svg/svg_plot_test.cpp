#include <gtest/gtest.h>

#include <cmath>

#include "report/sample_document.h"
#include "report/svg/plot_axis.h"
#include "report/svg/plot_labels.h"
#include "report/svg/svg_elements.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

Plot plot_of(std::vector<double> x, std::vector<double> y, bool log = false) {
    return {"p", "caption", "what is seen", "x [length]", "y [1/length]", log, log, {{"series", std::move(x), std::move(y), {}, {}}},
            {},  {}};
}

// ---- axes ---------------------------------------------------------------------------------------------------------------

TEST(PlotAxis, TicksAreRoundEvenAndInside) {
    for (const auto& [low, high] :
         std::vector<std::pair<double, double>>{{0, 1}, {-3, 7}, {0.12, 0.13}, {1e-7, 4e-7}, {-1e6, 5e5}, {99.9, 100.1}}) {
        const Axis axis({low, high}, false);
        const auto& ticks = axis.ticks();
        ASSERT_GE(ticks.size(), 3u) << low << " " << high;
        ASSERT_LE(ticks.size(), 12u);
        const double step = ticks[1].value - ticks[0].value;
        const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
        EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6) << step;
        std::set<std::string> labels;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            EXPECT_NEAR(ticks[i].value, ticks[0].value + double(i) * step, 1e-9 * step * double(i + 1));
            EXPECT_GE(axis.position(ticks[i].value), -1e-9);
            EXPECT_LE(axis.position(ticks[i].value), 1 + 1e-9);
            EXPECT_TRUE(labels.insert(ticks[i].label).second) << ticks[i].label << " twice";
        }
    }
}

TEST(PlotAxis, CoversItsValues) {
    for (const bool log : {false, true}) {
        for (const std::vector<double>& values :
             std::vector<std::vector<double>>{{1, 2}, {5}, {5, 5}, {1e-9, 1e9}, {1, 1 + 1e-15}, {1e-300, 1e200}}) {
            const Axis axis(values, log);
            for (const double v : values) {
                EXPECT_GE(axis.position(v), 0);
                EXPECT_LE(axis.position(v), 1);
            }
            EXPECT_LT(axis.low(), axis.high());
        }
    }
}

TEST(PlotAxis, HasARangeEvenWithoutValues) {
    for (const bool log : {false, true}) {
        for (const std::vector<double>& values : std::vector<std::vector<double>>{{}, {undefined}, {INFINITY, -INFINITY}}) {
            EXPECT_LT(Axis(values, log).low(), Axis(values, log).high());
            EXPECT_FALSE(Axis(values, log).ticks().empty());
        }
    }
    EXPECT_LT(0, Axis({-1, 0}, true).low());
}

TEST(PlotAxis, LogarithmicStepsAreEqualFactors) {
    const Axis axis({1e-3, 1e3}, true);
    EXPECT_NEAR(axis.position(1) - axis.position(0.1), axis.position(100) - axis.position(10), 1e-12);
    EXPECT_FALSE(axis.shows(0));
    EXPECT_FALSE(axis.shows(-1));
    EXPECT_TRUE(axis.shows(1e-9));
}

TEST(PlotAxis, ManyDecadesDoNotCrowd) {
    std::size_t labelled = 0;
    const Axis axis({1e-300, 1e200}, true);
    for (const Tick& tick : axis.ticks()) labelled += !tick.label.empty();
    EXPECT_GE(labelled, 3u);
    EXPECT_LE(labelled, 12u);
}

// ---- labels -------------------------------------------------------------------------------------------------------------

bool overlap(const Box& a, const Box& b) { return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom; }

TEST(PlotLabels, NeighboursDoNotCoverEachOtherAndStayInside) {
    const Box frame{0, 0, 600, 300};
    LabelPlacer placer(frame, {});
    std::vector<Box> boxes;
    for (const Point p : {Point{300, 150}, Point{304, 152}, Point{310, 150}, Point{598, 2}, Point{2, 298}})
        boxes.push_back(placer.place(around(p, 120, 17)));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_GE(boxes[i].left, frame.left);
        EXPECT_LE(boxes[i].right, frame.right);
        EXPECT_GE(boxes[i].top, frame.top);
        EXPECT_LE(boxes[i].bottom, frame.bottom);
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(boxes[i], boxes[k])) << i << " " << k;
    }
}

TEST(PlotLabels, KeepClearOfTheCurve) {
    std::vector<Point> curve;
    for (double x = 0; x <= 600; x += 6) curve.push_back({x, 100});
    LabelPlacer placer({0, 0, 600, 300}, curve);
    const Box box = placer.place(around({300, 100}, 120, 17));
    EXPECT_TRUE(box.bottom <= 100 || box.top >= 100);
}

TEST(PlotLabels, KeepClearOfTheCurveAlsoAtTheEdgeOfTheFrame) {
    std::vector<Point> curve;   // two hills, whose tops are close to the upper edge
    for (double x = 0; x <= 600; x += 2.5) curve.push_back({x, 8 + 200 * std::pow(std::cos(M_PI * x / 300 - M_PI / 2), 2)});
    for (Point& p : curve) p.y = 216 - p.y;
    LabelPlacer placer({0, 0, 600, 290}, curve);
    const Box box = placer.place(around({150, 8}, 160, 17));
    EXPECT_GE(box.top, 0);
    for (const Point& p : curve) EXPECT_FALSE(overlap(box, {p.x, p.y, p.x, p.y})) << p.x;
}

TEST(PlotLabels, WrappedLinesFitAndLoseNothing) {
    const std::string words = "a rather long name of a series that would not fit into the width of the plot";
    std::string rejoined;
    for (const std::string& line : wrapped(words, 150)) {
        EXPECT_LE(text_width(line), 150);
        rejoined += (rejoined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(rejoined, words);
    EXPECT_EQ(wrapped("", 100).size(), 1u);
}

// ---- the drawing ----------------------------------------------------------------------------------------------------------

/// No coordinate is NaN, infinite or outside the picture.
void expect_sane(const Plot& plot) {
    const std::string svg = svg_of(plot);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    const double height = std::stod(matches(svg, "viewBox=\"0 0 640 ([0-9.]+)\"").at(0));
    for (const std::string& x : matches(svg, " (?:x|x1|x2|cx)=\"([^\"]*)\"")) {
        EXPECT_GE(std::stod(x), 0);
        EXPECT_LE(std::stod(x), 640);
    }
    for (const std::string& y : matches(svg, " (?:y|y1|y2|cy)=\"([^\"]*)\"")) {
        EXPECT_GE(std::stod(y), 0);
        EXPECT_LE(std::stod(y), height);
    }
}

TEST(SvgPlot, IsValidForAnyData) {
    for (const bool log : {false, true}) {
        expect_sane(plot_of({}, {}, log));
        expect_sane(plot_of({3}, {7}, log));
        expect_sane(plot_of({1, 2, 3}, {5, 5, 5}, log));
        expect_sane(plot_of({1, 2, 3}, {undefined, undefined, undefined}, log));
        expect_sane(plot_of({1, 2, 3}, {1e-300, 1e200, -1}, log));
        expect_sane(plot_of({1, 2, 3}, {1, INFINITY, 2}, log));
        expect_sane(plot_of({0, 0}, {0, 0}, log));
        expect_sane(plot_of({1, 2}, {1}, log));
    }
    const Document sample = sample_document();
    for (const Block& block : sample.sections[0].blocks) {
        if (const auto* plot = std::get_if<Plot>(&block)) expect_sane(*plot);
    }
}

TEST(SvgPlot, IsWellFormedWithHostileNames) {
    if (!has_program("xmllint")) GTEST_SKIP() << "xmllint is not installed";
    const Plot plot = std::get<Plot>(hostile_document().sections[0].blocks.back());
    EXPECT_TRUE(is_well_formed(svg_of(plot)));
    EXPECT_TRUE(is_well_formed(svg_on_white(svg_of(plot))));
}

TEST(SvgPlot, UndefinedValuesLeaveAGap) {
    const auto starts = [](const std::string& svg) { return count_of(matches(svg, "<path d=\"([^\"]*)\" fill=\"none\"").at(0), "M"); };
    EXPECT_EQ(starts(svg_of(plot_of({1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}))), 1u);
    EXPECT_EQ(starts(svg_of(plot_of({1, 2, 3, 4, 5}, {1, 2, undefined, 4, 5}))), 2u);
}

TEST(SvgPlot, AValueBetweenTwoGapsIsAPoint) {
    EXPECT_EQ(count_of(svg_of(plot_of({1, 2, 3}, {undefined, 2, undefined})), "<circle"), 1u);
    EXPECT_NE(svg_of(plot_of({}, {})).find("no data"), std::string::npos);
}

TEST(SvgPlot, HigherValuesAreHigherUp) {
    Plot plot = plot_of({1, 2}, {1, 2});
    plot.series[0].style = Series::Style::points;
    const auto y = matches(svg_of(plot), "<circle cx=\"[^\"]*\" cy=\"([^\"]*)\"");
    ASSERT_EQ(y.size(), 3u);   // the last is the sample beside its name
    EXPECT_GT(std::stod(y[0]), std::stod(y[1]));
}

TEST(SvgPlot, SeriesDifferWithoutColour) {
    Plot plot = plot_of({}, {});
    plot.series.clear();
    for (int i = 0; i < 6; ++i) plot.series.push_back({"s" + std::to_string(i), {1, 2}, {1.0 + i, 2.0 + i}, {}, {}});
    const auto dashes = matches(svg_of(plot), "stroke-linejoin=\"round\" stroke-dasharray=\"([^\"]*)\"/>");
    EXPECT_EQ(std::set<std::string>(dashes.begin(), dashes.end()).size(), 5u);   // and the first is not dashed
    for (Series& series : plot.series) series.style = Series::Style::dashed;
    const auto all_dashed = matches(svg_of(plot), "stroke-linejoin=\"round\" stroke-dasharray=\"([^\"]*)\"/>");
    EXPECT_EQ(std::set<std::string>(all_dashed.begin(), all_dashed.end()).size(), 6u);
}

TEST(SvgPlot, NoTwoOfManySeriesLookAlike) {
    std::set<std::string> lines, points;   // of continuous and of dashed series, which one plot may mix
    for (std::size_t place = 0; place < 42; ++place) {
        for (const Series::Style style : {Series::Style::line, Series::Style::dashed}) {
            Series series;
            series.style = style;
            const Look look = look_of(series, place);
            EXPECT_TRUE(lines.insert(look.color + " " + look.dashes).second) << place;
            points.insert(point_shape({0, 0}, look.pattern, look.color));
        }
    }
    EXPECT_EQ(points.size(), 42u);
}

TEST(SvgPlot, ASeriesLooksTheSameWhereverItsColourAndPatternAreGiven) {
    Plot plot = plot_of({1, 2}, {1, 2});
    plot.series[0].style = Series::Style::line_and_points;
    plot.series[0].color = 3;
    plot.series[0].pattern = 6;
    const std::string path = matches(svg_of(plot), "<path d=\"[^\"]*\" fill=\"none\" (stroke=[^/]*)/>").at(0);
    EXPECT_NE(path.find("--plot-4,"), std::string::npos) << path;
    plot.series.insert(plot.series.begin(), {"other", {1, 2}, {2, 3}, {}, {}});
    const auto both = matches(svg_of(plot), "<path d=\"[^\"]*\" fill=\"none\" (stroke=[^/]*)/>");
    EXPECT_NE(both.at(0), path);
    EXPECT_EQ(both.at(1), path);
}

// ---- names and panels -------------------------------------------------------------------------------------------------------

TEST(PlotEnds, NamesThatFitDoNotOverlapAndStayNearTheirCurves) {
    for (const std::vector<double>& wanted : std::vector<std::vector<double>>{{}, {50}, {50, 50, 50}, {10, 90, 11, 89, 12}, {-5, 300}}) {
        const std::vector<double> heights(wanted.size(), 16), middles = spread_apart(wanted, heights, 0, 200);
        ASSERT_EQ(middles.size(), wanted.size());
        for (std::size_t i = 0; i < middles.size(); ++i) {
            EXPECT_GE(middles[i], 8);
            EXPECT_LE(middles[i], 192);
            for (std::size_t k = 0; k < i; ++k) {
                EXPECT_GE(std::abs(middles[i] - middles[k]), 16 - 1e-9);
                EXPECT_EQ(middles[i] < middles[k], wanted[i] < wanted[k] || (wanted[i] == wanted[k] && i < k));
            }
        }
    }
    EXPECT_EQ(spread_apart({20, 100, 180}, {16, 16, 16}, 0, 200), (std::vector<double>{20, 100, 180}));
    EXPECT_EQ(spread_apart({50, 50}, {20, 10}, 0, 200), (std::vector<double>{42.5, 57.5}));
    EXPECT_EQ(spread_apart({5, 5, 5}, {10, 10, 10}, 0, 12), (std::vector<double>{5, 15, 25}));   // they do not fit
}

/// Three meshes, two methods each.
Plot plot_of_panels() {
    Plot plot = plot_of({}, {});
    plot.series.clear();
    for (const double mesh : {1.0, 2.0, 3.0}) {
        for (const char* method : {"first", "second"}) {
            Series series{method, {1, 2, 3}, {mesh, mesh + 1, mesh * (method[0] == 'f' ? 1 : 3)}, {}, {}};
            series.panel = "mesh " + std::to_string(int(mesh));
            plot.series.push_back(series);
        }
    }
    return plot;
}

TEST(SvgPlot, SmallPlotsShareAxesLooksAndNames) {
    const Plot plot = plot_of_panels();
    expect_sane(plot);
    const std::string svg = svg_of(plot);
    const auto curves = matches(svg, "<path d=\"M[^\"]*\" fill=\"none\" (stroke=[^/]*)/>");
    ASSERT_EQ(curves.size(), 6u);
    for (const std::size_t i : {2u, 3u, 4u, 5u}) EXPECT_EQ(curves[i], curves[i - 2]) << "a name has one look";
    EXPECT_NE(curves[0], curves[1]);
    EXPECT_EQ(count_of(svg, ">second</text>"), 1u) << "named once, at the ends of the last panel's";
    for (const char* name : {"mesh 1", "mesh 2", "mesh 3"}) EXPECT_EQ(count_of(svg, std::string(">") + name + "</text>"), 1u);
    Plot all_different = plot;
    for (Series& series : all_different.series) series.name += " " + series.panel;
    expect_sane(all_different);
    for (const Series& series : all_different.series) EXPECT_EQ(count_of(svg_of(all_different), ">" + series.name + "</text>"), 1u);
}

TEST(SvgPlot, MarkersStandInTheirPanel) {
    Plot plot = plot_of_panels();
    plot.markers = {{2, 2, "here", "mesh 2"}, {2, 2, "nowhere", "mesh 4"}};
    const std::string svg = svg_of(plot);
    EXPECT_EQ(count_of(svg, ">here</text>"), 1u);
    EXPECT_EQ(count_of(svg, ">nowhere</text>"), 0u);
}

// Names have the colours of their curves; the sample of the line beside them distinguishes them in grey.
TEST(SvgPlot, CurvesAreNamedAtTheirEnds) {
    Plot plot = plot_of({1, 2, 3}, {1, 2, 3});
    plot.series.push_back({"falling", {1, 2, 3}, {3, 2, 1}, {}, {}});
    plot.series.push_back({"scattered", {2, 1, 3}, {3, 2, 1}, {}, {}, Series::Style::points});
    const std::string svg = svg_of(plot);
    const double rising = std::stod(matches(svg, "translate\\([0-9.]+ ([0-9.]+)\\)").at(0)),
                 falling = std::stod(matches(svg, "translate\\([0-9.]+ ([0-9.]+)\\)").at(1));
    EXPECT_LT(rising, falling - 100);
    EXPECT_NE(svg.find("fill=\"var(--plot-2, #c2410c)\">falling</text>"), std::string::npos);
    EXPECT_EQ(count_of(svg, ">scattered</text>"), 1u) << "in the legend: it has no end";
}

TEST(SvgPlot, ZeroHasAPlaceOnALogarithmicAxisOfX) {
    Plot plot = plot_of({0, 1, 10}, {1, 2, 3}, true);
    const std::string svg = svg_of(plot);
    EXPECT_EQ(count_of(svg, ">0</text>"), 1u);
    EXPECT_EQ(count_of(matches(svg, "<path d=\"(M[^\"]*)\" fill=\"none\"").at(0), "L"), 2u) << "all three points are drawn";
    const Axis axis({0, 1, 10}, true, true);
    EXPECT_LT(axis.position(0), axis.position(1));
    EXPECT_GE(axis.position(1), Axis::zero_share);
    EXPECT_FALSE(Axis({1, 10}, true, true).shows(0));
    EXPECT_FALSE(Axis({0, -1}, true, true).shows(0));
}

/// Words are 12 units high at least and 7 points on paper, where print.css makes a drawing 136 mm wide; indices, which are lowered letters,
/// are as small as those of the text.
void expect_readable(const std::string& svg) {
    const double width = std::stod(matches(svg, "viewBox=\"0 0 ([0-9.]+) ").at(0)), points_a_unit = 136 / 25.4 * 72 / width;
    EXPECT_NEAR(width, 640, 1e-9) << "what the page shows it at, at least";
    for (const std::string& size : matches(svg, "<(?:svg|text|g)[^>]* font-size=\"([0-9.]+)\"")) {
        EXPECT_GE(std::stod(size), 12) << svg;
        EXPECT_GE(std::stod(size) * points_a_unit, 7) << svg;
    }
    for (const std::string& size : matches(svg, "font-size=\"([0-9.]+)\"")) EXPECT_GE(std::stod(size) * points_a_unit, 6.5) << svg;
}

TEST(Svg, WordsAreLargeEnoughOnThePageAndOnPaper) {
    expect_readable(svg_of(plot_of_panels()));
    const Document sample = sample_document();
    for (const Block& block : sample.sections[0].blocks) {
        if (const auto* plot = std::get_if<Plot>(&block)) expect_readable(svg_of(*plot));
        if (const auto* map = std::get_if<Map>(&block)) expect_readable(svg_of(*map));
        if (const auto* diagram = std::get_if<Diagram>(&block)) expect_readable(svg_of(*diagram));
    }
}

TEST(SvgPlot, HasATitleAndADescription) {
    const std::string svg = svg_of(plot_of({1, 2}, {1, 2}));
    EXPECT_NE(svg.find("role=\"img\""), std::string::npos);
    EXPECT_NE(svg.find("<desc id=\"p-desc\">what is seen</desc>"), std::string::npos);
    EXPECT_NE(svg.find("y [1/length] against x [length]"), std::string::npos);
    EXPECT_NE(svg.find("var(--plot-1, #0b5fa5)"), std::string::npos);
    EXPECT_EQ(svg.find(" style=\""), std::string::npos);
}

}   // namespace
}   // namespace meshfolio::report
