#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "output/draw/figure_request.h"
#include "output/draw/flat_mesh.h"
#include "output/draw/surface_of.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::undefined;

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

}   // namespace

TEST(RobustRange, ThePaleMapBeginsAtZeroUnlessValuesAreNegative) {
    EXPECT_EQ(robust_range({panel({3, 4, 5})}, "pale", "q", "u", 0, 0).low, 0);
    EXPECT_EQ(robust_range({panel({3, 4, 5})}, "pale", "q", "u", 0, 0).high, 5);
    EXPECT_EQ(robust_range({panel({-3, 4, 5})}, "pale", "q", "u", 0, 0).low, -3);
    EXPECT_EQ(robust_range({panel({3, 4, 5})}, "viridis", "q", "u", 0, 0).low, 3);
}

TEST(RobustRange, WithoutClippingItIsMinimumAndMaximum) {
    const ColorRange range = robust_range({panel({3, -1, 2}), panel({7})}, "viridis", "q", "u", 0, 0);
    EXPECT_EQ(range.low, -1);
    EXPECT_EQ(range.high, 7);
    EXPECT_EQ(range.clipped_below, 0);
    EXPECT_EQ(range.clipped_above, 0);
}

TEST(RobustRange, NearlyEqualSignedValuesDoNotReachTheColourOfTheEnd) {
    const ColorRange equal = robust_range({panel({12, 12, 12, 13})}, "diverging", "q", "u", 0, 0),
                     wide = robust_range({panel({-1, 2, 9})}, "diverging", "q", "u", 0, 0);
    EXPECT_EQ(equal.high, 15);
    EXPECT_EQ(equal.low, -15);
    EXPECT_EQ(wide.high, 9);
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

// Only some of the values are put in order: they are those that a whole sort would put there, also where nearly all crowd together.
TEST(RobustRange, PercentilesOfManyValuesEqualThoseOfAFullSort) {
    for (const double power : {1.0, 9.0, 301.0}) {
        Panel p = ramp(200'003);
        p.values = (p.values.array() * 0.7).sin().sign() * (p.values.array() * 0.7).sin().abs().pow(power);
        std::vector<double> sorted(p.values.begin(), p.values.end());
        std::sort(sorted.begin(), sorted.end());
        const ColorRange range = robust_range({p}, "viridis", "", "", 0, 0.01);
        const double at = 0.01 * 200'002;
        const auto below = static_cast<std::size_t>(at);
        EXPECT_EQ(range.low, sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below])) << power;
        for (std::size_t i = 0; i < 8192; ++i) ASSERT_EQ(range.sample[i], sorted[(2 * i + 1) * 200'003 / 16384]) << power << ' ' << i;
    }
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

TEST(Histogram, CountsEveryValueInTheRangeOnce) {
    Panel p = ramp(9600);
    const ColorRange range = robust_range({p, panel({undefined, INFINITY})}, "viridis", "", "", 0, 0.02);
    const std::vector<double> shares = histogram(finite_values({p}), range.low, range.high);
    ASSERT_EQ(shares.size(), 96u);
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1 - range.clipped_below - range.clipped_above, 1e-12);
    for (const double share : shares) EXPECT_NEAR(share, 0.96 / 96, 2.0 / 9600);
}

TEST(Histogram, EndsBelongToTheFirstAndTheLastBin) {
    const std::vector<double> shares = histogram(std::vector<double>{0, 0, 24, 12, -1, 25, 23.5, 0.5}, 0, 24);
    ASSERT_EQ(shares.size(), 24u);
    EXPECT_EQ(shares.front(), 3.0 / 8);
    EXPECT_EQ(shares.back(), 2.0 / 8);
    EXPECT_EQ(shares[12], 1.0 / 8);
}

TEST(Histogram, HasFewerBinsForFewValues) {
    for (const auto& [n, bins] : {std::pair{10, 24u}, {1535, 24u}, {1536, 48u}, {3071, 48u}, {3072, 96u}, {100'000, 96u}})
        EXPECT_EQ(histogram(finite_values({ramp(n)}), 0, n).size(), bins) << n;
}

TEST(Histogram, IsEmptyWithoutValuesOrRangeAndFiniteForHugeNumbers) {
    EXPECT_TRUE(histogram({}, 0, 1).empty());
    EXPECT_TRUE(histogram(std::vector<double>{1}, 1, 1).empty());
    EXPECT_TRUE(histogram(std::vector<double>{1}, undefined, 1).empty());
    const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(histogram(std::vector<double>{-huge, 0, huge}, -huge, huge)[12], 1.0 / 3);
    EXPECT_TRUE(histogram(std::vector<double>{0, tiny}, 0, tiny).empty());
}

// The sample is small however many values there are, does not depend on their order, and shows their spread to 1 % of the highest bin.
TEST(Histogram, OfTheSampleNearlyEqualsThatOfAllValues) {
    Panel p = ramp(100'003);
    p.values = (p.values.array() / 20'000).sin().cube();
    Panel reversed = p;
    reversed.values.reverseInPlace();
    ColorRange range = robust_range({p}, "diverging", "", "", 0);
    EXPECT_LE(range.sample.size(), 8192u);
    EXPECT_EQ(range.sample, robust_range({reversed}, "diverging", "", "", 0).sample);
    for (const auto& [low, high] : {std::pair{range.low, range.high}, {-0.2, 0.7}}) {
        range.low = low, range.high = high;   // as --range does
        const std::vector<double> all = histogram(finite_values({p}), low, high);
        const std::vector<double> shown = color_bar_of(range, false, render::DrawOptions()).histogram;
        ASSERT_EQ(shown.size(), all.size());
        const double highest = *std::max_element(all.begin(), all.end());
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(shown[i], all[i], 0.01 * highest + 1.0 / 8192) << i;
    }
}
