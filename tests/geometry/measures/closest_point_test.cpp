#include "geometry/measures/closest_point.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

using Exact = Eigen::Matrix<long double, 3, 1>;

/// Straight from the definition, with more digits: the nearest of the three sides, and of the plane where p lies over the triangle.
double exact_distance(const Vector3& p, const Vector3& x0, const Vector3& x1, const Vector3& x2) {
    const Exact q = p.cast<long double>();
    const std::array<Exact, 3> x{x0.cast<long double>(), x1.cast<long double>(), x2.cast<long double>()};
    const Exact normal = (x[1] - x[0]).cross(x[2] - x[0]);
    long double nearest = std::numeric_limits<long double>::infinity();
    bool over = normal.squaredNorm() > 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Exact a = x[k], along = x[(k + 1) % 3] - a;
        const long double length = along.squaredNorm(), t = length > 0 ? (q - a).dot(along) / length : 0;
        nearest = std::min(nearest, (q - a - std::clamp(t, 0.0L, 1.0L) * along).norm());
        over = over && normal.dot(along.cross(q - a)) >= 0;
    }
    return static_cast<double>(over ? std::min(nearest, std::abs(normal.dot(q - x[0])) / normal.norm()) : nearest);
}

double brute_force(const Vector3& p, const TriangleMesh& mesh) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t)
        nearest = std::min(nearest, exact_distance(p, mesh.X.row(mesh.F(t, 0)), mesh.X.row(mesh.F(t, 1)), mesh.X.row(mesh.F(t, 2))));
    return nearest;
}

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

// From near and far, of triangles of all shapes down to a width of no digit: to 1e-12 of the way to their corners.
TEST(DistanceToTriangle, AgreesWithTheDefinition) {
    NormalNumbers random(9);
    const auto vector = [&] { return Vector3(random.next(), random.next(), random.next()); };
    for (const double width : {1.0, 1e-3, 1e-7, 1e-10, 1e-12, 1e-14, 0.0}) {
        for (const double away : {1e-6, 1.0, 1e4, 1e8}) {
            for (int repeat = 0; repeat < 100; ++repeat) {
                const Vector3 a = vector(), b = vector(), across = vector();
                const Vector3 c = a + random.uniform() * (b - a) + width * across;
                const Vector3 beside =
                    repeat % 2 == 0 ? vector() : Vector3(random.next() * (b - a) + random.next() * across);   // in its plane
                const Vector3 p = a + random.uniform() * (b - a) + away * beside;
                const double found = std::sqrt(squared_distance_to_triangle(p, a, b, c)), scale = (p - a).norm() + (b - a).norm();
                EXPECT_NEAR(found, exact_distance(p, a, b, c), 1e-12 * scale) << width << " " << away;
                const double bound = found * found * (1 + 1e-9);
                EXPECT_NEAR(std::sqrt(squared_distance_to_triangle(p, a, b, c, bound)), found, 1e-12 * scale);
                EXPECT_GE(squared_distance_to_triangle(p, a, b, c, bound / 2), bound / 2 * (1 - 1e-15));
            }
        }
    }
}

TEST(ClosestPoint, AgreesWithBruteForce) {
    NormalNumbers random(4);
    TriangleMesh flattened = irregular_sphere(2), needle = flattened;   // into a plane, and a line: without area
    flattened.X.col(1).setZero();
    needle.X.leftCols(2).setZero();
    for (const TriangleMesh& mesh :
         {irregular_sphere(3), cube_mesh(5), irregular_plane(9), flattened, needle, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}) {
        const ClosestPoint surface(mesh);
        for (int repeat = 0; repeat < 200; ++repeat) {
            const Vector3 p = (repeat % 4 == 0 ? 1e6 : 1.0) * Vector3(random.next(), random.next(), random.next());
            const double squared = surface.squared_distance(p);
            EXPECT_NEAR(std::sqrt(squared), brute_force(p, mesh), 1e-12 * std::max(1.0, p.norm()));
            EXPECT_EQ(surface.squared_distance(p, 0.5 * squared), 0.5 * squared);
            const double early = surface.squared_distance(p, 10 * squared, 2 * squared);
            EXPECT_GE(early, squared);
            EXPECT_LE(early, 2 * squared);
        }
    }
}

TEST(ClosestPoint, FollowsMotionAndScale) {
    const TriangleMesh mesh = irregular_sphere(3), moved = rotated_and_moved(scaled(mesh, 7));
    const ClosestPoint surface(mesh), moved_surface(moved);
    NormalNumbers random(6);
    TriangleMesh points = mesh;   // moved along
    for (Eigen::Index i = 0; i < points.X.rows(); ++i) points.X.row(i) << random.next(), random.next(), random.next();
    const TriangleMesh moved_points = rotated_and_moved(scaled(points, 7));
    for (Eigen::Index i = 0; i < points.X.rows(); ++i) {
        const double plain = surface.squared_distance(points.X.row(i)), after = moved_surface.squared_distance(moved_points.X.row(i));
        EXPECT_NEAR(std::sqrt(after) / 7, std::sqrt(plain), 1e-12);
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
