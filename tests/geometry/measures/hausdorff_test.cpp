#include "geometry/measures/hausdorff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

constexpr double rounding = 1e-11;   // allowed for coordinates of about 1

/// The value is enclosed, and so narrowly as was asked for.
void expect_encloses(const HausdorffDistance& found, double value, double accuracy = default_accuracy, double size = 1) {
    EXPECT_LE(found.distance, value + rounding * size);
    EXPECT_GE(found.bound, value - rounding * size);
    EXPECT_LE(found.bound, found.distance * (1 + accuracy) + rounding * size);
    EXPECT_TRUE(found.reached);
}

void expect_both_ways(const TriangleMesh& a, const TriangleMesh& b, double value, double size = 1) {
    for (const double accuracy : {1e-1, 1e-3, 1e-6}) {
        expect_encloses(hausdorff_distance(a, b, accuracy), value, accuracy, size);
        expect_encloses(hausdorff_distance(b, a, accuracy), value, accuracy, size);
    }
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both{Positions(a.X.rows() + b.X.rows(), 3), Faces(a.F.rows() + b.F.rows(), 3)};
    both.X << a.X, b.X;
    both.F << a.F, b.F.array() + a.vertex_count();
    return both;
}

TriangleMesh moved(const TriangleMesh& mesh, const Vector3& by) { return {mesh.X.rowwise() + by.transpose(), mesh.F}; }

/// [−side/2, side/2]² without [−hole/2, hole/2]².
TriangleMesh frame(double side, double hole) {
    TriangleMesh mesh{Positions(8, 3), Faces(8, 3)};
    for (int i = 0; i < 4; ++i) {
        const double x = i == 1 || i == 2 ? 0.5 : -0.5, y = i < 2 ? -0.5 : 0.5;
        mesh.X.row(i) << side * x, side * y, 0;
        mesh.X.row(i + 4) << hole * x, hole * y, 0;
        mesh.F.row(2 * i) << i, (i + 1) % 4, (i + 1) % 4 + 4;
        mesh.F.row(2 * i + 1) << i, (i + 1) % 4 + 4, i + 4;
    }
    return mesh;
}

TriangleMesh random_triangles(int count, std::uint64_t seed) {
    NormalNumbers random(seed);
    TriangleMesh mesh{Positions(3 * count, 3), Faces(count, 3)};
    for (double& x : mesh.X.reshaped()) x = random.uniform();
    for (int i = 0; i < 3 * count; ++i) mesh.F(i / 3, i % 3) = i;
    mesh.X.topRows<3>().rowwise() = mesh.X.row(0);                            // a point
    mesh.X.row(5) = 0.3 * mesh.X.row(3) + 0.7 * mesh.X.row(4);                // a segment
    mesh.X.row(8) = mesh.X.row(6) + 1e-7 * (mesh.X.row(8) - mesh.X.row(7));   // a needle
    return mesh;
}

/// The largest of the distances at the points of a grid of k parts a side, and how far any point is from one of the grid at most.
std::pair<double, double> brute_force(const TriangleMesh& from, const TriangleMesh& to, int k) {
    double largest = 0, step = 0;
    for (Eigen::Index t = 0; t < from.F.rows(); ++t) {
        const Eigen::Matrix3d x = from.X(from.F.row(t), Eigen::all).transpose();
        step = std::max(step, (x.col(1) - x.col(0)).norm() + (x.col(2) - x.col(0)).norm());
        for (int i = 0; i <= k; ++i) {
            for (int j = 0; i + j <= k; ++j) {
                const Vector3 p = x.col(0) + 1.0 * i / k * (x.col(1) - x.col(0)) + 1.0 * j / k * (x.col(2) - x.col(0));
                double nearest = infinity;
                for (Eigen::Index u = 0; u < to.F.rows(); ++u) {
                    const auto corner = [&](int c) -> Vector3 { return to.X.row(to.F(u, c)); };
                    nearest = std::min(nearest, squared_distance_to_triangle(p, corner(0), corner(1), corner(2), nearest));
                }
                largest = std::max(largest, nearest);
            }
        }
    }
    return {std::sqrt(largest), step / k};
}

TEST(Hausdorff, BetweenParallelPlanesIsTheirStep) {
    for (const double step : {3.0, 0.25, 1e-3, 1e-9})
        expect_both_ways(grid_mesh(2, 2, 1, 1), moved(irregular_plane(20), {0, 0, step}), step);
    const HausdorffDistance tiny = hausdorff_distance(grid_mesh(2, 2, 1, 1), moved(irregular_plane(20), {0, 0, 1e-9}));
    EXPECT_LE(tiny.bound, 1.001e-9);
    expect_both_ways(rotated_and_moved(irregular_plane(5)), rotated_and_moved(moved(irregular_plane(9), {0, 0, 0.1})), 0.1, 20);
}

// The middle of the gap in a needle is 100 from both halves; with a plate 50 below it, 50 from that.
TEST(Hausdorff, SeesTheGapInANeedle) {
    const TriangleMesh needle = triangle({0, 0, 0}, {1000, 0, 0}, {1000, 1e-3, 0});
    const TriangleMesh parts =
        joined(triangle({0, 0, 0}, {400, 0, 0}, {400, 4e-4, 0}), triangle({600, 0, 0}, {1000, 0, 0}, {1000, 1e-3, 0}));
    for (const auto& [depth, far] : {std::pair{200.0, 100.0}, {50.0, 50.0}}) {
        const TriangleMesh plate = moved(grid_mesh(2, 2, 1000, 1000), {0, 0, -depth});
        expect_both_ways(joined(plate, needle), joined(plate, parts), far, 1000);
    }
}

// The middle of a square hole is half a side from its edges, and between two holes, the larger counts.
TEST(Hausdorff, SeesHoles) {
    for (const double hole : {0.7, 3.0, 1e-3}) expect_both_ways(frame(100, 1e-9), frame(100, hole), hole / 2, 100);
    const auto two = [](double first, double second) { return joined(frame(10, first), moved(frame(10, second), {20, 0, 0})); };
    expect_both_ways(two(1e-9, 1e-9), two(2, 3), 1.5, 100);
}

// A square turned by 45° about its middle: its corners stick out by (√2 − 1)/2 sides.
TEST(Hausdorff, OfATurnedSquare) {
    const TriangleMesh square = moved(irregular_plane(6), {-0.5, -0.5, 0});
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(pi / 4, Vector3::UnitZ()).toRotationMatrix();
    expect_both_ways(square, {square.X * turn, square.F}, (std::sqrt(2.0) - 1) / 2);
}

TEST(Hausdorff, OfScaledAndMovedBodies) {
    expect_both_ways(cube_mesh(1), scaled(cube_mesh(1), 2), std::sqrt(3.0) / 2);   // outer corner to inner corner; back it is only ½
    TriangleMesh tip = fan(6);
    tip.X(0, 2) = 3;
    expect_both_ways(fan(6), tip, 3);
    const TriangleMesh sphere = icosphere(3), outer = scaled(icosphere(2), 1.5);
    const HausdorffDistance found = hausdorff_distance(sphere, outer);
    EXPECT_LT(found.distance, 0.5 + 0.02);
    EXPECT_GT(found.bound, 0.5 - 1e-9);   // corner over corner
}

TEST(Hausdorff, IsZeroWithinRoundingBetweenEqualSurfaces) {
    const TriangleMesh sphere = irregular_sphere(2), plane = grid_mesh(2, 2, 1, 1);
    for (const auto& found : {hausdorff_distance(sphere, sphere), hausdorff_distance(plane, irregular_plane(15))}) {
        EXPECT_LT(found.distance, 1e-15);
        EXPECT_LT(found.bound, 1e-12);
        EXPECT_GT(found.bound, 0);   // coordinates are rounded
        EXPECT_TRUE(found.reached);
    }
    const TriangleMesh empty{Positions(0, 3), Faces(0, 3)};
    EXPECT_EQ(hausdorff_distance(empty, empty).bound, 0);
    EXPECT_THROW(hausdorff_distance(sphere, empty), MeshError);
}

// Of triangles without area, too. No point of a triangle is farther than one step from a point of the grid.
TEST(Hausdorff, ContainsBruteForce) {
    const auto expect_agreement = [](const TriangleMesh& a, const TriangleMesh& b, int k) {
        const auto [there, step] = brute_force(a, b, k);
        const auto [back, step_back] = brute_force(b, a, k);
        const double largest = std::max(there, back);
        double low = 0, high = infinity;
        for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-6}) {
            const HausdorffDistance found = hausdorff_distance(a, b, accuracy);
            EXPECT_GE(found.bound, largest * (1 - 1e-12));
            EXPECT_LE(found.distance, std::max(there + step, back + step_back));
            EXPECT_LE(found.bound, found.distance * (1 + accuracy) + rounding);
            EXPECT_GE(found.bound, low);   // the enclosures have a point in common
            EXPECT_LE(found.distance, high);
            low = std::max(low, found.distance - rounding);
            high = std::min(high, found.bound + rounding);
        }
    };
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) expect_agreement(random_triangles(5, seed), random_triangles(7, seed + 100), 40);
    const TriangleMesh a = irregular_sphere(1);
    const auto with = [&](const Positions& X) { return TriangleMesh{X, a.F}; };
    Positions blob = 0.1 * a.X, flattened = a.X;
    blob.col(2).array() += 0.7;
    flattened.col(0).setZero();
    for (const Positions& X :
         {with_gaussian_noise(a.X, Vector3(0.05, 0.1, 0.02), 5), blob, flattened, rotated_and_moved(a).X, Positions(0 * a.X)})
        expect_agreement(a, with(X), 6);
}

TEST(Hausdorff, FollowsMotionAndScaleAndIsTheSameFromBothSides) {
    const TriangleMesh a = irregular_sphere(2), b = irregular_sphere(1, 1.1, 0.3, 5);
    const HausdorffDistance found = hausdorff_distance(a, b, 1e-9);
    const double value = found.distance;
    expect_encloses(hausdorff_distance(b, a), value);
    expect_encloses(hausdorff_distance(rotated_and_moved(a), rotated_and_moved(b)), value, default_accuracy, 20);
    for (const double s : {7.0, 1e30, 1e-30, 1e90}) {
        HausdorffDistance scaled_up = hausdorff_distance(scaled(a, s), scaled(b, s));
        scaled_up.distance /= s;
        scaled_up.bound /= s;
        expect_encloses(scaled_up, value);
    }
    TriangleMesh near = a, other = b;
    near.X = (near.X * 0x1p20).array().round();
    other.X = (other.X * 0x1p20).array().round();
    const double plain = hausdorff_distance(near, other).distance;
    for (TriangleMesh* mesh : {&near, &other}) mesh->X.array() += 0x1p50;
    EXPECT_EQ(hausdorff_distance(near, other).distance, plain);
}

TEST(Hausdorff, LeavesOutVerticesThatNoTriangleUses) {
    TriangleMesh a = fan(6);
    a.X.conservativeResize(8, 3);
    a.X.row(7) << 1, 2, 3;
    TriangleMesh b = a;
    b.X.row(7) << 100, 200, 300;
    EXPECT_LT(hausdorff_distance(a, b).bound, 1e-10);
}

// A point in the middle of a sphere is equally far from all of its parts: no tree leaves any of them out, and the work has a limit.
TEST(Hausdorff, EndsWhereAllPartsAreEquallyNear) {
    const TriangleMesh sphere = icosphere(6), speck = scaled(irregular_sphere(2), 1e-6);
    TriangleMesh repeated = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    repeated.F = Faces(repeated.F.replicate(200000, 1));
    const HausdorffDistance found = hausdorff_distance(sphere, speck), of_repeated = hausdorff_distance(repeated, speck);
    EXPECT_LE(found.distance, 1 + 1e-9);
    EXPECT_GE(found.bound, 1 - 1e-6);
    EXPECT_LE(found.bound, 1.01);
    EXPECT_LE(of_repeated.distance, 1);   // from a corner to the nearest side of the speck
    EXPECT_GE(of_repeated.bound, 1 - 1e-5);
    EXPECT_LE(of_repeated.bound, 1.001);
}

}   // namespace
}   // namespace meshfolio
