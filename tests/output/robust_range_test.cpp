#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "output/figure_request.h"

using namespace meshfolio;
using namespace meshfolio::output;

namespace {

Panel panel(std::initializer_list<double> values) {
    Panel p;
    p.values.resize(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), p.values.begin());
    return p;
}

Panel ramp(int n) {
    Panel p;
    p.values = Vector::LinSpaced(n, 0, n - 1);
    return p;
}

const double undefined = std::numeric_limits<double>::quiet_NaN();

}   // namespace

TEST(RobustRange, WithoutClippingItIsMinimumAndMaximum) {
    const ColorRange range = robust_range({panel({3, -1, 2}), panel({7})}, "viridis", "q", "u", 0, 0);
    EXPECT_EQ(range.low, -1);
    EXPECT_EQ(range.high, 7);
    EXPECT_EQ(range.clipped_below, 0);
    EXPECT_EQ(range.clipped_above, 0);
}

TEST(RobustRange, OneOutlierDoesNotMoveIt) {
    Panel p = ramp(1001);
    p.values[1000] = 1e9;
    const ColorRange range = robust_range({p}, "viridis", "", "", 0, 0.02);
    EXPECT_NEAR(range.low, 20, 1e-9);
    EXPECT_NEAR(range.high, 980, 1e-9);
    EXPECT_NEAR(range.clipped_below, 20.0 / 1001, 1e-12);
    EXPECT_NEAR(range.clipped_above, 20.0 / 1001, 1e-12);
}

TEST(RobustRange, DivergingIsSymmetricAboutZero) {
    const ColorRange range = robust_range({panel({-1, 0, 5})}, "diverging", "", "", 0, 0);
    EXPECT_EQ(range.low, -5);
    EXPECT_EQ(range.high, 5);
}

TEST(RobustRange, RoundingNoiseIsNotStretchedIntoColours) {
    const ColorRange flat = robust_range({panel({1e-16, -2e-16, 0})}, "diverging", "", "", 0.1);
    EXPECT_DOUBLE_EQ(flat.high - flat.low, 0.1);
    EXPECT_DOUBLE_EQ(flat.high + flat.low, 0);
    const ColorRange constant = robust_range({panel({4, 4, 4})}, "viridis", "", "", 0.5);
    EXPECT_DOUBLE_EQ(constant.low, 3.75);
    EXPECT_DOUBLE_EQ(constant.high, 4.25);
}

TEST(RobustRange, UndefinedValuesDoNotCount) {
    const ColorRange with = robust_range({panel({undefined, 1, INFINITY, 2, -INFINITY})}, "viridis", "", "", 0, 0);
    EXPECT_EQ(with.low, 1);
    EXPECT_EQ(with.high, 2);
    const ColorRange none = robust_range({panel({undefined})}, "viridis", "", "", 1);
    EXPECT_TRUE(std::isfinite(none.low) && none.low < none.high);
}

TEST(RobustRange, ScalesWithTheValues) {
    Panel scaled = ramp(500);
    scaled.values *= 3;
    const ColorRange one = robust_range({ramp(500)}, "viridis", "", "", 0), three = robust_range({scaled}, "viridis", "", "", 0);
    EXPECT_NEAR(three.low, 3 * one.low, 1e-9);
    EXPECT_NEAR(three.high, 3 * one.high, 1e-9);
    EXPECT_EQ(three.clipped_above, one.clipped_above);
}
