#include "mesh/vertex_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

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

/// Returns the largest distance between the empirical and the normal distribution function.
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
    // Box–Muller gives numbers in pairs: partners and numbers of neighbouring pairs are compared, by value and by size.
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

TEST(VertexNoise, HasUnitsOfTheMesh) {
    const TriangleMesh box{.X = Positions{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 12}}, .F = Faces{{0, 1, 2}, {0, 1, 3}}};
    EXPECT_EQ(noise_unit(box, "raw"), Vector3(1, 1, 1));
    EXPECT_EQ(noise_unit(box, "bbox"), Vector3(3, 4, 12));
    EXPECT_EQ(noise_unit(box, "diagonal"), Vector3(13, 13, 13));
    EXPECT_EQ(noise_unit(box, "h"), Vector3::Constant(mean_edge_length(box)));
}

TEST(VertexNoise, IsAddedToThePositions) {
    const Positions X = Positions::Random(100, 3);
    const Positions noise = with_gaussian_noise(Positions::Zero(100, 3), {0.1, 0.1, 0.1}, 8);
    EXPECT_LT((with_gaussian_noise(X, {0.1, 0.1, 0.1}, 8) - X - noise).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(VertexNoise, HasTheRequestedDeviationAndIndependentAxes) {
    const Vector3 sigma(0.3, 0.02, 5);
    const Positions noise = with_gaussian_noise(Positions::Zero(many, 3), sigma, 9);
    for (int a = 0; a < 3; ++a) {
        const double deviation = std::sqrt(noise.col(a).squaredNorm() / many);
        EXPECT_NEAR(deviation / sigma[a], 1, four_sigma / std::sqrt(2.0 * many));
        EXPECT_NEAR(correlation(noise.col(a), noise.col((a + 1) % 3)), 0, four_sigma / std::sqrt(many));
    }
}

namespace {

double mean_square(const Positions& displacement) { return displacement.rowwise().squaredNorm().mean(); }

/// Returns the displacements by noise of a kind.
Positions noise_on(const TriangleMesh& mesh, NoiseKind kind, double sigma, std::uint64_t seed = 5) {
    return with_noise(mesh, kind, sigma, seed) - mesh.X;
}

int moved_rows(const Positions& displacement) { return static_cast<int>((displacement.rowwise().squaredNorm().array() > 0).count()); }

}   // namespace

TEST(NoiseKinds, AllAreEquallyStrong) {
    const TriangleMesh mesh = ellipsoid_mesh(5, {3, 2, 0.5});   // 10242 vertices
    const double n = mesh.vertex_count(), sigma = 0.01;
    for (const NoiseEntry& entry : noise_list()) {
        const double squares = entry.kind == NoiseKind::impulsive ? 3 * impulsive_share * n : n;   // at least so many independent ones
        EXPECT_NEAR(mean_square(noise_on(mesh, entry.kind, sigma)) / (3 * sigma * sigma), 1, four_sigma * std::sqrt(2 / squares))
            << entry.name;
    }
}

TEST(NoiseKinds, NormalNoiseIsAlongTheNormalsAndHasTheRequestedDeviation) {
    const TriangleMesh mesh = ellipsoid_mesh(4, {3, 2, 0.5});
    const Positions noise = noise_on(mesh, NoiseKind::normal, 0.2 / std::sqrt(3), 7), N = vertex_normals(mesh);
    EXPECT_LT((noise - N.cwiseProduct(noise.cwiseProduct(N).rowwise().sum().replicate<1, 3>())).cwiseAbs().maxCoeff(), 1e-14);
    const Vector along = noise.cwiseProduct(N).rowwise().sum();
    EXPECT_NEAR(std::sqrt(along.squaredNorm() / mesh.vertex_count()) / 0.2, 1, four_sigma / std::sqrt(2.0 * mesh.vertex_count()));
    EXPECT_NEAR(along.mean() / 0.2, 0, four_sigma / std::sqrt(mesh.vertex_count()));
}

TEST(NoiseKinds, NormalNoiseTurnsWithTheMesh) {
    const TriangleMesh mesh = ellipsoid_mesh(2, {3, 2, 0.5});
    const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.7).normalized()).toRotationMatrix();
    const TriangleMesh turned = moved_to(mesh, (2 * mesh.X * R.transpose()).rowwise() + Eigen::RowVector3d(3, -5, 2));
    const Positions expected = 2 * noise_on(mesh, NoiseKind::normal, 0.1) * R.transpose();
    EXPECT_LT((noise_on(turned, NoiseKind::normal, 0.2) - expected).cwiseAbs().maxCoeff(), 1e-13)
        << "twice as large on a mesh twice as large";
}

TEST(NoiseKinds, VerticesWithoutANormalStay) {
    TriangleMesh mesh = icosphere(1);
    const Positions X = mesh.X;
    mesh.X.conservativeResize(X.rows() + 1, 3);
    mesh.X.row(X.rows()) << 7, 8, 9;
    EXPECT_EQ(with_noise(mesh, NoiseKind::normal, 0.1, 3).row(X.rows()), mesh.X.row(X.rows()));
}

TEST(NoiseKinds, BoxNoiseIsAShareOfEveryExtent) {
    const TriangleMesh mesh = ellipsoid_mesh(5, {3, 2, 0.5});
    const Vector3 extent = bounding_box(mesh).extent();
    const double share = 0.2, n = mesh.vertex_count();
    const Positions noise = noise_on(mesh, NoiseKind::box, share * extent.norm() / std::sqrt(3));
    for (int axis = 0; axis < 3; ++axis) {
        const double deviation = std::sqrt(noise.col(axis).squaredNorm() / n);
        EXPECT_NEAR(deviation / (share * extent[axis]), 1, four_sigma / std::sqrt(2 * n)) << axis;
    }
    const Positions flat = noise_on(grid_mesh(5, 5, 1, 1), NoiseKind::box, 0.1);
    EXPECT_TRUE((flat.col(2).array() == 0).all()) << "no extent, no noise";
}

TEST(NoiseKinds, ImpulsesHitTheStatedShareAndAllVerticesAlike) {
    const TriangleMesh mesh = icosphere(3);   // 642 vertices
    Vector hits = Vector::Zero(mesh.vertex_count());
    constexpr int seeds = 400;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const Positions noise = noise_on(mesh, NoiseKind::impulsive, 0.1, seed);
        EXPECT_EQ(moved_rows(noise), 64);
        hits += (noise.rowwise().squaredNorm().array() > 0).cast<double>().matrix();
    }
    // Each vertex is hit with the same probability, 64/642.
    const double p = 64.0 / 642, deviation = std::sqrt(p * (1 - p) * seeds);
    EXPECT_LT((hits.array() - p * seeds).abs().maxCoeff(), 4.5 * deviation);
    EXPECT_NEAR(hits.head(321).sum() / hits.sum(), 0.5, 0.02);
    EXPECT_EQ(moved_rows(noise_on(cube_mesh(1), NoiseKind::impulsive, 0.1)), 1) << "at least one";
}

TEST(NoiseKinds, NoNoiseMovesNothing) {
    const TriangleMesh mesh = icosphere(1);
    for (const NoiseEntry& entry : noise_list()) EXPECT_EQ(with_noise(mesh, entry.kind, 0, 1), mesh.X) << entry.name;
}

TEST(NoiseKinds, BoxNoiseOnAPointIsRefused) {
    TriangleMesh point = cube_mesh(1);
    point.X.setZero();
    EXPECT_THROW(with_noise(point, NoiseKind::box, 1, 1), MeshError);
}
