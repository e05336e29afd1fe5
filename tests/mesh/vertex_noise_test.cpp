#include "mesh/vertex_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace meshfolio;

namespace {

std::vector<double> normal_numbers(std::uint64_t seed, int n) {
    NormalNumbers random(seed);
    std::vector<double> numbers(static_cast<std::size_t>(n));
    for (double& x : numbers) x = random.next();
    return numbers;
}

double moment(const std::vector<double>& numbers, int power) {
    double sum = 0;
    for (const double x : numbers) sum += std::pow(x, power);
    return sum / static_cast<double>(numbers.size());
}

/// Largest distance between the empirical and the normal distribution function.
double kolmogorov_distance(std::vector<double> numbers) {
    std::ranges::sort(numbers);
    const double n = static_cast<double>(numbers.size());
    double distance = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double expected = 0.5 * std::erfc(-numbers[i] / std::sqrt(2));
        const double below = static_cast<double>(i);
        distance = std::max({distance, std::abs(below / n - expected), std::abs((below + 1) / n - expected)});
    }
    return distance;
}

double correlation(const Vector& a, const Vector& b) {
    const Vector u = a.array() - a.mean(), v = b.array() - b.mean();
    return u.dot(v) / (u.norm() * v.norm());
}

constexpr int many = 200000;
constexpr double four_sigma = 4;   // a good generator fails such a bound once in 16,000 seeds; the seeds are fixed

}   // namespace

TEST(NormalNumbers, UniformTakesTheUpper53BitsOfTheStandardEngine) {
    std::mt19937_64 engine(7);
    NormalNumbers random(7);
    for (int i = 0; i < 1000; ++i) {
        const double expected = std::ldexp(static_cast<double>(engine() >> 11), -53);
        const double u = random.uniform();
        EXPECT_EQ(u, expected);
        EXPECT_GE(u, 0);
        EXPECT_LT(u, 1);
    }
}

TEST(NormalNumbers, MomentsAreThoseOfTheNormalDistribution) {
    for (const std::uint64_t seed : {0, 1, 2}) {
        const auto x = normal_numbers(seed, many);
        EXPECT_NEAR(moment(x, 1), 0, four_sigma * std::sqrt(1.0 / many));
        EXPECT_NEAR(moment(x, 2), 1, four_sigma * std::sqrt(2.0 / many));
        EXPECT_NEAR(moment(x, 3), 0, four_sigma * std::sqrt(15.0 / many));
        EXPECT_NEAR(moment(x, 4), 3, four_sigma * std::sqrt(96.0 / many));
    }
}

TEST(NormalNumbers, FollowTheNormalDistributionFunction) {
    // P(√n D > 1.95) = 0.001 (Kolmogorov).
    EXPECT_LT(kolmogorov_distance(normal_numbers(3, many)), 1.95 / std::sqrt(many));
}

TEST(NormalNumbers, NeighboursAreIndependent) {
    // Box–Muller gives numbers in pairs: partners, and numbers of neighbouring pairs, in value and in size.
    const auto x = normal_numbers(4, many);
    for (const int lag : {1, 2, 3}) {
        const Eigen::Map<const Vector> all(x.data(), many);
        const Vector a = all.head(many - lag), b = all.tail(many - lag);
        EXPECT_NEAR(correlation(a, b), 0, four_sigma / std::sqrt(many)) << lag;
        EXPECT_NEAR(correlation(a.cwiseAbs2(), b.cwiseAbs2()), 0, four_sigma / std::sqrt(many)) << lag;
    }
}

TEST(VertexNoise, SameSeedSameBitsOtherSeedOtherBits) {
    const Positions X = Positions::Zero(100, 3);
    EXPECT_EQ(with_gaussian_noise(X, {1, 1, 1}, 5), with_gaussian_noise(X, {1, 1, 1}, 5));
    EXPECT_NE(with_gaussian_noise(X, {1, 1, 1}, 5), with_gaussian_noise(X, {1, 1, 1}, 6));
}

TEST(VertexNoise, FirstRowsDoNotDependOnHowManyFollow) {
    const Positions long_one = with_gaussian_noise(Positions::Zero(100, 3), {1, 2, 3}, 5);
    const Positions short_one = with_gaussian_noise(Positions::Zero(10, 3), {1, 2, 3}, 5);
    EXPECT_EQ(short_one, long_one.topRows(10));
}

TEST(VertexNoise, ScalesWithSigmaAxisByAxis) {
    const Positions unit = with_gaussian_noise(Positions::Zero(100, 3), {1, 1, 1}, 5);
    const Positions scaled = with_gaussian_noise(Positions::Zero(100, 3), {0.5, 0, 4}, 5);
    EXPECT_EQ(scaled.col(0), 0.5 * unit.col(0));
    EXPECT_TRUE((scaled.col(1).array() == 0).all());
    EXPECT_EQ(scaled.col(2), 4 * unit.col(2));
}

TEST(VertexNoise, IsAddedToThePositions) {
    const Positions X = Positions::Random(100, 3);
    const Positions noise = with_gaussian_noise(Positions::Zero(100, 3), {0.1, 0.1, 0.1}, 8);
    EXPECT_LT((with_gaussian_noise(X, {0.1, 0.1, 0.1}, 8) - X - noise).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(VertexNoise, HasTheAskedDeviationAndIndependentAxes) {
    const Vector3 sigma(0.3, 0.02, 5);
    const Positions noise = with_gaussian_noise(Positions::Zero(many, 3), sigma, 9);
    for (int a = 0; a < 3; ++a) {
        const double deviation = std::sqrt(noise.col(a).squaredNorm() / many);
        EXPECT_NEAR(deviation / sigma[a], 1, four_sigma / std::sqrt(2.0 * many));
        EXPECT_NEAR(correlation(noise.col(a), noise.col((a + 1) % 3)), 0, four_sigma / std::sqrt(many));
    }
}
