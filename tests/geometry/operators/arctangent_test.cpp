#include "geometry/operators/arctangent-inl.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/linear/special_values.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {
namespace {

double angle_of(double sine, double cosine) { return hwy::HWY_NAMESPACE::GetLane(HWY_NAMESPACE::angle_of(sine, cosine).lanes); }

// Two units in the last place, for sides of very different size, and next to the bounds between the cases.
TEST(Arctangent, HasItsDigits) {
    NormalNumbers random(1);
    double worst = 0;
    const auto look_at = [&](double sine, double cosine) {
        const long double truth = std::atan2(static_cast<long double>(sine), static_cast<long double>(cosine));
        worst = std::max(worst, std::abs(static_cast<double>((angle_of(sine, cosine) - truth) / truth)));
    };
    for (int i = 0; i < 200'000; ++i) {
        const double sine = std::ldexp(random.uniform() + 1e-9, -(i % 40)), cosine = std::ldexp(2 * random.uniform() - 1, -(i / 40 % 40));
        look_at(sine, cosine);
        look_at(sine * 1e100, cosine * 1e100);
    }
    for (int k = 1; k < 8; ++k) {
        for (int step = -3; step <= 3; ++step) look_at(std::sin(k * pi / 8) * (1 + 1e-15 * step), std::cos(k * pi / 8));
    }
    EXPECT_LT(worst, 4.5e-16);
}

TEST(Arctangent, IsExactWhereTheAngleIsAMultipleOfARightOne) {
    EXPECT_EQ(angle_of(0, 1), 0);
    EXPECT_EQ(angle_of(1, 0), pi / 2);
    EXPECT_EQ(angle_of(0, -1), pi);
    EXPECT_EQ(angle_of(1, 1), pi / 4);
    EXPECT_EQ(angle_of(0, 0), 0);   // as std::atan2 says
}

TEST(Arctangent, SupplementsAddUp) {
    NormalNumbers random(2);
    for (int i = 0; i < 10'000; ++i) {
        const double sine = random.uniform(), cosine = random.uniform();
        EXPECT_NEAR(angle_of(sine, cosine) + angle_of(sine, -cosine), pi, 5e-16);
    }
}

}   // namespace
}   // namespace meshfolio
