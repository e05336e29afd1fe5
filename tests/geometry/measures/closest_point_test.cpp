#include "geometry/measures/closest_point.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

TEST(DistanceToTriangle, ToItsInsideItsEdgesAndItsCorners) {
    const Vector3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
    const auto distance = [&](const Vector3& p) { return std::sqrt(squared_distance_to_triangle(p, a, b, c)); };
    EXPECT_NEAR(distance({1, 1, -2}), 2, 1e-15);
    EXPECT_NEAR(distance({2, -3, 4}), 5, 1e-15);
    EXPECT_NEAR(distance({-2, 1, 0}), 2, 1e-15);
    EXPECT_NEAR(distance({4, 3, 0}), 12.0 / 5, 1e-15);   // from the far corner of the rectangle to its diagonal
    EXPECT_NEAR(distance({-1, -2, 2}), 3, 1e-15);
    EXPECT_NEAR(distance({7, -4, 0}), 5, 1e-15);
    EXPECT_NEAR(distance({0, 5, 0}), 2, 1e-15);
    EXPECT_EQ(distance({0.5, 0.5, 0}), 0);
}

// The smallest of the distances to a fine net of points of the triangle is never smaller, and hardly larger.
TEST(DistanceToTriangle, AgreesWithSampling) {
    NormalNumbers random(8);
    const auto point = [&] { return Vector3(random.next(), random.next(), random.next()); };
    for (int repeat = 0; repeat < 50; ++repeat) {
        const Vector3 a = point(), b = point(), c = point(), p = 2 * point();
        const int n = 60;
        double sampled = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; i + j <= n; ++j) sampled = std::min(sampled, (a + (b - a) * i / n + (c - a) * j / n - p).norm());
        }
        const double distance = std::sqrt(squared_distance_to_triangle(p, a, b, c));
        EXPECT_LE(distance, sampled + 1e-14);
        EXPECT_GT(distance, sampled - ((b - a).norm() + (c - a).norm()) / n);
    }
}

TEST(DistanceToTriangle, WithoutAreaItIsASegmentOrAPoint) {
    const Vector3 a(0, 0, 0), b(1, 0, 0), c(3, 0, 0);
    EXPECT_NEAR(squared_distance_to_triangle({2, 2, 0}, a, b, c), 4, 1e-15);
    EXPECT_NEAR(squared_distance_to_triangle({5, 0, 0}, a, b, c), 4, 1e-15);
    EXPECT_NEAR(squared_distance_to_triangle({0, 3, 4}, a, a, a), 25, 1e-15);
}

TEST(ClosestPoint, AgreesWithBruteForce) {
    NormalNumbers random(4);
    for (const TriangleMesh& mesh : {irregular_sphere(3), cube_mesh(5), irregular_plane(9), triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}) {
        const ClosestPoint surface(mesh);
        for (int repeat = 0; repeat < 200; ++repeat) {
            const Vector3 p(random.next(), random.next(), random.next());
            double brute = std::numeric_limits<double>::infinity();
            for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
                brute = std::min(
                    brute, squared_distance_to_triangle(p, mesh.X.row(mesh.F(t, 0)), mesh.X.row(mesh.F(t, 1)), mesh.X.row(mesh.F(t, 2))));
            }
            EXPECT_DOUBLE_EQ(surface.squared_distance(p), brute);   // compilers round sums of three squares in ways of their own
            EXPECT_EQ(surface.squared_distance(p, 0.5 * brute), 0.5 * brute);
            const double early = surface.squared_distance(p, 10 * brute, 2 * brute);
            EXPECT_GE(early, brute * (1 - 1e-15));
            EXPECT_LE(early, std::max(2 * brute, brute));
        }
    }
}

TEST(ClosestPoint, ManyTrianglesInOnePlace) {
    TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.F = Faces(mesh.F.replicate(1000, 1));
    EXPECT_NEAR(ClosestPoint(mesh).squared_distance({0.2, 0.2, 3}), 9, 1e-15);
}

TEST(ClosestPoint, RefusesAnEmptySurface) {
    TriangleMesh empty;
    EXPECT_THROW(ClosestPoint{empty}, MeshError);
}

}   // namespace
}   // namespace meshfolio
