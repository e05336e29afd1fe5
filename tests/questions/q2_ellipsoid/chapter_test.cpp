#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/answer_laws.h"
#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {
using namespace testing_tools;

namespace {

const Answer& answer() {
    static const Answer answer = chapter_of_id("q2").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    return answer;
}

const report::Plot& plot_named(const std::string& id) {
    for (const report::Block& block : answer().section.blocks) {
        if (const auto* plot = std::get_if<report::Plot>(&block); plot && plot->id == id) return *plot;
    }
    throw std::logic_error("no plot " + id);
}

/// Returns the directions of the marked maxima [π rad].
std::vector<double> maxima_of(const report::Plot& plot) {
    const double largest = std::ranges::max_element(plot.markers, {}, &report::Marker::y)->y;
    std::vector<double> at;
    for (const report::Marker& marker : plot.markers)
        if (marker.y > largest - 1e-12) at.push_back(marker.x);
    return at;
}

}   // namespace

TEST(Q2, PassesItsOwnChecks) {
    expect_well_formed(answer());
    expect_checks_pass(answer().section);
}

TEST(Q2, MaximaPointAlongTheShorterOfTheOtherAxes) {
    EXPECT_EQ(maxima_of(plot_named("q2_tip_b_above_c")), (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(maxima_of(tip_plot(tip_of(tall_ellipsoid), "tall")), (std::vector<double>{0, 1, 2}));
}

// All extrema are marked, but equal ones have one label.
TEST(Q2, ExtremaAreNamedOnce) {
    for (const Ellipsoid& ellipsoid : {flat_ellipsoid, tall_ellipsoid}) {
        std::vector<std::string> labels;
        for (const report::Marker& marker : tip_plot(tip_of(ellipsoid), "plot").markers)
            if (!marker.label.empty()) labels.push_back(marker.label.substr(0, 7));
        std::ranges::sort(labels);
        EXPECT_EQ(labels, (std::vector<std::string>{"maximum", "minimum"}));
    }
}

TEST(Q2, TheTwoReadingsOfADirectionShareOnlyTheExtrema) {
    const report::Plot& plot = plot_named("q2_tip_b_above_c");
    ASSERT_EQ(plot.series.size(), 2u);
    const auto &angle = plot.series[0], &parameters = plot.series[1];
    EXPECT_NEAR(angle.x.back(), 2, 1e-15);
    double largest = 0;
    for (std::size_t i = 0; i < angle.x.size(); ++i) largest = std::max(largest, angle.y[i] - parameters.y[i]);
    EXPECT_NE(plot.alt.find("differ most, by " + readable(largest)), std::string::npos) << plot.alt;
    for (std::size_t i = 0; i < angle.x.size(); ++i) {
        const bool at_extremum = std::abs(std::sin(2 * M_PI * angle.x[i])) < 1e-9;
        const double gap = angle.y[i] - parameters.y[i];
        if (at_extremum) {
            EXPECT_NEAR(gap, 0, 1e-12);
        } else {
            EXPECT_GT(gap, 0) << angle.x[i];   // weighted arithmetic against harmonic mean
        }
    }
}

TEST(Q2, ThePrincipalCurvaturesAtTheTipHaveTheClosedForm) {
    for (const report::Block& block : answer().section.blocks) {
        const auto* table = std::get_if<report::Table>(&block);
        if (!table || table->id != "q2_tip") continue;
        for (const auto& row : table->rows) {
            const auto number = [&](std::size_t i) { return std::get<double>(row[i]); };
            const double a = number(0), b = number(1), c = number(2);
            EXPECT_NEAR(number(3), std::min(a / (b * b), a / (c * c)), 1e-12);
            EXPECT_NEAR(number(5), std::max(a / (b * b), a / (c * c)), 1e-12);
        }
        return;
    }
    FAIL() << "no table q2_tip";
}

// Checks the products that the derivation writes out.
TEST(Q2, ThirdEntryOfTheSecondFormIsMinusTheSupportFunction) {
    for (const auto& [u, v] : {std::pair{0.3, 0.9}, std::pair{2.0, 2.2}, std::pair{4.5, 1.4}}) {
        const auto [a, b, c] = flat_ellipsoid;
        const FundamentalForms forms = ellipsoid_forms(flat_ellipsoid, u, v);
        const Vector3 p = ellipsoid_point(flat_ellipsoid, u, v);
        const double D = forms.p_u.cross(forms.p_v).norm() / std::sin(v);
        EXPECT_NEAR(forms.II(1, 1), -p.dot(forms.normal), 1e-12);
        EXPECT_NEAR(-p.dot(forms.normal), a * b * c / D, 1e-12);
        EXPECT_NEAR(forms.II(0, 0), a * b * c * std::pow(std::sin(v), 2) / D, 1e-12);
        EXPECT_NEAR(forms.II(0, 1), 0, 1e-12);
    }
}

// The circles of the diagram have the radii 1/κ_n, and touch the ellipse at its tip without crossing it nearby.
TEST(Q2, TheCirclesOfTheDiagramOsculate) {
    const Tip tip = tip_of(flat_ellipsoid);
    const auto [a, b, c] = tip.ellipsoid;
    const report::Diagram diagram = angle_diagram(tip);
    ASSERT_EQ(diagram.panels.size(), 3u);
    for (const auto& [panel, half_height] : {std::pair{1u, b}, std::pair{2u, c}}) {
        const auto& paths = diagram.panels[panel].paths;
        const auto circle = std::ranges::find_if(paths, [](auto& path) { return path.style == report::Diagram::Style::accent; });
        ASSERT_NE(circle, paths.end());
        const auto [left, right] = std::ranges::minmax(circle->x);
        EXPECT_NEAR(right, a, 1e-9);
        EXPECT_NEAR((right - left) / 2, half_height * half_height / a, 1e-3);
        for (std::size_t i = 0; i < circle->x.size(); ++i) {
            const double inside = std::pow(circle->x[i] / a, 2) + std::pow(circle->y[i] / half_height, 2);
            EXPECT_LE(inside, 1 + 1e-9);   // at the end of the longer axis the circle lies within
        }
    }
}

TEST(Q2, OtherSeedsTryOtherPoints) {
    QuestionSettings settings = quick_settings();
    settings.seed = 2;
    const Answer other = chapter_of_id("q2").answer(MeshLibrary({}, {}), settings, no_progress);
    expect_checks_pass(other.section);
    EXPECT_NE(prose_of(other.section), prose_of(answer().section));
}

}   // namespace meshfolio::q2_ellipsoid
