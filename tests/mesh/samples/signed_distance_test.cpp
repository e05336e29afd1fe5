#include "mesh/samples/signed_distance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mesh/vertex_noise.h"

using namespace meshfolio;

namespace {

/// Returns points all around, the same on every machine.
std::vector<Vector3> points(int n) {
    NormalNumbers random(11);
    std::vector<Vector3> p(static_cast<std::size_t>(n));
    for (Vector3& q : p) q = Vector3(random.next(), random.next(), random.next());
    return p;
}

}   // namespace

TEST(SignedDistance, RoundConeIsTheUnionOfItsBalls) {
    const RoundCone cone{{-0.4, 0.1, 0}, {0.7, 0.3, 0.2}, 0.5, 0.2};
    for (const Vector3& p : points(200)) {
        double nearest = 1e9;
        for (int i = 0; i <= 20000; ++i) {
            const double t = i / 20000.0;
            nearest = std::min(nearest, signed_distance(Ball{cone.a + t * (cone.b - cone.a), 0.5 - 0.3 * t}, p));
        }
        EXPECT_NEAR(signed_distance(cone, p), nearest, 1e-8);
    }
}

TEST(SignedDistance, EllipsoidVanishesOnItAndHasSlopeOneThere) {
    const EllipsoidBody body{{0.1, 0.2, 0.3}, {1.7, 1.1, 0.6}, frame_along({1, 2, 3}, {0, 1, 0})};
    for (const Vector3& q : points(200)) {
        const Vector3 on_body = q.normalized().cwiseProduct(body.half_axes);
        const Vector3 normal = q.normalized().cwiseQuotient(body.half_axes).normalized();
        const Vector3 p = body.centre + body.frame.transpose() * on_body;
        EXPECT_NEAR(signed_distance(body, p), 0, 1e-14);
        const Vector3 step = 1e-5 * (body.frame.transpose() * normal);
        EXPECT_NEAR(signed_distance(body, p + step) - signed_distance(body, p - step), 2e-5, 1e-9);
    }
    EXPECT_EQ(signed_distance(body, body.centre), -0.6);
}

TEST(SignedDistance, RoundBoxIsTheOffsetOfASmallerBox) {
    const RoundBox box{{1, 0.8, 0.6}, 0.2};
    EXPECT_NEAR(signed_distance(box, {3, 0, 0}), 2, 1e-15);
    EXPECT_NEAR(signed_distance(box, {0, 0, 0}), -0.6, 1e-15);
    for (const Vector3& p : points(200)) {
        const Vector3 inner = p.cwiseMax(Vector3(-0.8, -0.6, -0.4)).cwiseMin(Vector3(0.8, 0.6, 0.4));
        if (inner != p) {
            EXPECT_NEAR(signed_distance(box, p), (p - inner).norm() - 0.2, 1e-15);
        }
    }
}

TEST(SmoothUnion, IsTheMinimumAwayFromTheCreaseAndBelowItThere) {
    EXPECT_EQ(smooth_union(1, 2, 0.5), 1);
    EXPECT_EQ(smooth_union(2, 1, 0.5), 1);
    EXPECT_NEAR(smooth_union(1, 1, 0.6), 1 - 0.1, 1e-15);
    for (double b = 0; b < 2; b += 0.01) {
        EXPECT_LE(smooth_union(1, b, 0.5), std::min(1.0, b));
        EXPECT_EQ(smooth_union(1, b, 0.5), smooth_union(b, 1, 0.5));
        EXPECT_LE(std::abs(smooth_union(1, b + 1e-6, 0.5) - smooth_union(1, b, 0.5)), 1e-6 * (1 + 1e-6));   // slope within [0, 1]
    }
}

TEST(SmoothDifference, TakesTheSecondOutOfTheFirst) {
    EXPECT_EQ(smooth_difference(-3, -1, 0.5), 1);
    EXPECT_EQ(smooth_difference(-1, 3, 0.5), -1);
}

TEST(FrameAlong, IsARotation) {
    const Eigen::Matrix3d frame = frame_along({1, 2, 2}, {0, 0, 5});
    EXPECT_LT((frame * frame.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
    EXPECT_NEAR(frame.determinant(), 1, 1e-15);
    EXPECT_LT((frame * Vector3(1, 2, 2) - Vector3(3, 0, 0)).norm(), 1e-15);
    EXPECT_GT(frame(1, 2), 0);
}
