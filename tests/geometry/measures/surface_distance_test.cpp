#include "geometry/measures/surface_distance.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/errors.h"
#include "geometry/measures/closest_point.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

/// Each triangle into four at the middles of its edges: the same surface.
TriangleMesh split_at_middles(const TriangleMesh& mesh) {
    TriangleMesh fine{mesh.X, Faces(4 * mesh.F.rows(), 3)};
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
        const auto [it, fresh] = middles.try_emplace(std::minmax(i, j), fine.vertex_count());
        if (fresh) {
            fine.X.conservativeResize(fine.X.rows() + 1, 3);
            fine.X.row(fine.X.rows() - 1) = 0.5 * (mesh.X.row(i) + mesh.X.row(j));
        }
        return it->second;
    };
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        const int a = mesh.F(t, 0), b = mesh.F(t, 1), c = mesh.F(t, 2), ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.F.middleRows<4>(4 * t) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    return fine;
}

void expect_near(const DistancesTo& one, const DistancesTo& other, double tolerance) {
    EXPECT_NEAR(one.max, other.max, tolerance);
    EXPECT_NEAR(one.mean, other.mean, tolerance);
    EXPECT_NEAR(one.rms, other.rms, tolerance);
}

TriangleMesh square(double side, double height, bool turned = false) {
    const TriangleMesh mesh = grid_mesh(2, 2, side, side);
    TriangleMesh placed = turned ? turned_inside_out(mesh) : mesh;
    placed.X.rowwise() += Eigen::RowVector3d(-side / 2, -side / 2, height);
    return placed;
}

TEST(SurfaceDistance, BetweenParallelPlanesIsTheirStep) {
    const TriangleMesh coarse = rotated_and_moved(grid_mesh(2, 2, 1, 1));
    TriangleMesh fine = irregular_plane(9);
    fine.X.col(2).array() += 0.25;
    const SurfaceDistances d = surface_distances(coarse, rotated_and_moved(fine));
    for (const DistancesTo& one : {d.a_to_b, d.b_to_a}) {
        for (const double distance : {one.max, one.of_vertices.minCoeff(), one.of_pieces.minCoeff()}) EXPECT_NEAR(distance, 0.25, 1e-14);
        for (const double distance : {one.mean, one.rms}) EXPECT_NEAR(distance, 0.25, 1e-11);   // sums of thousands
        EXPECT_NEAR(one.areas.sum(), 1, 1e-11);
        EXPECT_NEAR(one.mean_normal_angle, 0, 1e-11);
    }
}

// d = x sin θ over [0, 1]²: mean ½ sin θ, mean square ⅓ sin²θ.
TEST(SurfaceDistance, GrowsAlongARamp) {
    const double angle = 0.3;
    const TriangleMesh ramp{grid_mesh(2, 2, 1, 1).X * Eigen::AngleAxisd(-angle, Vector3::UnitY()).toRotationMatrix().transpose(),
                            grid_mesh(2, 2, 1, 1).F};
    const DistancesTo d = surface_distances(ramp, square(6, 0)).a_to_b;
    EXPECT_NEAR(d.max, std::sin(angle), 1e-14);
    EXPECT_NEAR(d.mean, std::sin(angle) / 2, 1e-11);
    EXPECT_NEAR(d.rms, std::sin(angle) / std::sqrt(3), 3e-5 * d.rms);
    EXPECT_NEAR(d.mean_normal_angle, angle, 1e-11);
    EXPECT_NEAR(surface_distances(ramp, square(6, 0, true)).a_to_b.mean_normal_angle, pi - angle, 1e-10);
}

TEST(SurfaceDistance, BetweenConcentricSpheresTendsToTheDifferenceOfTheirRadii) {
    double before = 0;
    for (const int level : {2, 3, 4}) {
        const TriangleMesh around = icosphere(level, 1.5);
        const SurfaceDistances d = surface_distances(icosphere(level), {around.X * some_rotation().transpose(), around.F});
        double error = 0;
        for (const DistancesTo& one : {d.a_to_b, d.b_to_a})
            for (const double distance : {one.max, one.mean, one.rms}) error = std::max(error, std::abs(distance - 0.5));
        EXPECT_LT(error, 0.1 * std::pow(0.25, level - 2));
        if (before > 0) {
            EXPECT_NEAR(before / error, 4, 1);
        }
        before = error;
    }
}

// The corners of both lie on the other surface: only interior points have a distance.
TEST(SurfaceDistance, FindsWhatIsFarBetweenTheVertices) {
    TriangleMesh frame = grid_mesh(4, 4, 3, 3);
    Faces ring(16, 3);
    int kept = 0;
    for (Eigen::Index t = 0; t < frame.F.rows(); ++t) {
        const Vector3 centre = (frame.X.row(frame.F(t, 0)) + frame.X.row(frame.F(t, 1)) + frame.X.row(frame.F(t, 2))) / 3;
        if ((centre.head<2>().array() - 1.5).abs().maxCoeff() > 0.5) ring.row(kept++) = frame.F.row(t);
    }
    ASSERT_EQ(kept, 16);
    frame.F = ring;
    const SurfaceDistances d = surface_distances(grid_mesh(2, 2, 3, 3), frame);
    EXPECT_EQ(d.b_to_a.max, 0);
    EXPECT_EQ(d.a_to_b.of_vertices.maxCoeff(), 0);
    EXPECT_NEAR(d.a_to_b.max, 0.5, 5e-4);
    EXPECT_GE(d.hausdorff.bound, 0.5);
    // Over the hole, a square of side 1, the distance is a pyramid of height ½ and mean ⅙; over all nine squares a ninth of that.
    EXPECT_NEAR(d.a_to_b.mean, 1.0 / 54, 1e-4);
}

TEST(SurfaceDistance, AgreesWithBruteForce) {
    const TriangleMesh a = irregular_sphere(2);
    TriangleMesh b = cube_mesh(3);
    b.X = with_gaussian_noise(b.X, Vector3(0.05, 0.1, 0.02), 5);
    const auto brute_force = [&](const Vector3& p) {
        double nearest = infinity;
        for (Eigen::Index t = 0; t < b.F.rows(); ++t)
            nearest = std::min(nearest, squared_distance_to_triangle(p, b.X.row(b.F(t, 0)), b.X.row(b.F(t, 1)), b.X.row(b.F(t, 2))));
        return std::sqrt(nearest);
    };
    const DistancesTo d = surface_distances(a, b).a_to_b;
    for (int v = 0; v < a.vertex_count(); ++v) EXPECT_NEAR(d.of_vertices[v], brute_force(a.X.row(v)), 1e-13);
    EXPECT_EQ(vertex_distances(a, b), d.of_vertices);
    // Nine points of each triangle, in place of some hundred.
    double mean = 0, rms = 0, max = 0;
    const Vector area = face_areas(a);
    for (Eigen::Index t = 0; t < a.F.rows(); ++t) {
        const auto at = [&](double s, double u) -> Vector3 {
            return (1 - s - u) * a.X.row(a.F(t, 0)) + s * a.X.row(a.F(t, 1)) + u * a.X.row(a.F(t, 2));
        };
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const bool tip = i + j > 2;   // mirrored into the triangle
                const double distance =
                    brute_force(tip ? at((3 - i - 1.0 / 3) / 3, (3 - j - 1.0 / 3) / 3) : at((i + 1.0 / 3) / 3, (j + 1.0 / 3) / 3));
                mean += area[t] / 9 * distance;
                rms += area[t] / 9 * distance * distance;
                max = std::max(max, distance);
            }
        }
    }
    EXPECT_NEAR(mean / area.sum(), d.mean, 2e-3 * d.mean);
    EXPECT_NEAR(std::sqrt(rms / area.sum()), d.rms, 2e-3 * d.rms);
    EXPECT_LE(max, d.max * (1 + 1e-3));
}

TEST(SurfaceDistance, IsTheSameFromBothSidesAndFollowsMotionAndScale) {
    const TriangleMesh a = irregular_sphere(2), b = scaled(cube_mesh(4), 1.7);
    const SurfaceDistances d = surface_distances(a, b), back = surface_distances(b, a);
    expect_near(d.a_to_b, back.b_to_a, 1e-12);
    expect_near(d.b_to_a, back.a_to_b, 1e-12);
    EXPECT_NEAR(d.hausdorff.distance, back.hausdorff.distance, 1e-14);
    expect_near(surface_distances(rotated_and_moved(a), rotated_and_moved(b)).a_to_b, d.a_to_b, 1e-12);
    for (const double s : {7.0, 1e30, 1e-30, 1e90}) {
        SurfaceDistances rescaled = surface_distances(scaled(a, s), scaled(b, s));
        for (double* length : {&rescaled.a_to_b.max, &rescaled.a_to_b.mean, &rescaled.a_to_b.rms}) *length /= s;
        expect_near(rescaled.a_to_b, d.a_to_b, 1e-11);
        EXPECT_NEAR(rescaled.a_to_b.mean_normal_angle, d.a_to_b.mean_normal_angle, 1e-3);
    }
}

TEST(SurfaceDistance, DoesNotDependOnHowTheOtherSurfaceIsDivided) {
    const TriangleMesh a = irregular_sphere(2), b = irregular_sphere(1, 1.2, 0.3, 5);
    const DistancesTo to_coarse = surface_distances(a, b).a_to_b, to_fine = surface_distances(a, split_at_middles(b)).a_to_b;
    expect_near(to_fine, to_coarse, 1e-13);
    EXPECT_LT((to_fine.of_vertices - to_coarse.of_vertices).cwiseAbs().maxCoeff(), 1e-13);
    const SurfaceDistances same = surface_distances(a, split_at_middles(a));
    EXPECT_LT(same.hausdorff.distance, 1e-14);
    EXPECT_LT(same.a_to_b.mean_normal_angle, 1e-7);
}

TEST(SurfaceDistance, IsNeverBelowThatOfTheVertices) {
    const TriangleMesh a = irregular_sphere(2);
    const TriangleMesh b{with_gaussian_noise(a.X, Vector3(0.05, 0.1, 0.02), 5), a.F};
    const SurfaceDistances d = surface_distances(a, b);
    for (const DistancesTo& one : {d.a_to_b, d.b_to_a}) EXPECT_LE(one.of_vertices.maxCoeff(), d.hausdorff.distance);
    EXPECT_LE(d.hausdorff.bound, compare_meshes(a, b).max + 1e-11);   // no point moves farther than the corners around it
}

TEST(SurfaceDistance, WithoutAreaHasAMaximumAndNoMean) {
    const TriangleMesh needle = triangle({0, 0, 1}, {1, 0, 1}, {3, 0, 2}), flat = triangle({0, 0, 1}, {1, 0, 1}, {3, 0, 1});
    const SurfaceDistances d = surface_distances(flat, square(8, 0));
    EXPECT_NEAR(d.a_to_b.max, 1, 1e-15);
    EXPECT_TRUE(std::isnan(d.a_to_b.mean) && std::isnan(d.a_to_b.rms) && std::isnan(d.a_to_b.mean_normal_angle));
    EXPECT_TRUE(area_histogram(d.a_to_b, 1, 4).empty());
    EXPECT_TRUE(std::isfinite(d.b_to_a.mean));
    EXPECT_TRUE(std::isnan(d.b_to_a.mean_normal_angle));
    EXPECT_NEAR(surface_distances(needle, square(8, 0)).a_to_b.max, 2, 1e-15);
    EXPECT_THROW(surface_distances(flat, {flat.X, Faces(0, 3)}), MeshError);
    EXPECT_THROW(vertex_distances({flat.X, Faces(0, 3)}, {flat.X, Faces(0, 3)}), MeshError);
}

TEST(SurfaceDistance, LeavesOutVerticesThatNoTriangleUses) {
    TriangleMesh stray = square(1, 0.5);
    stray.X.conservativeResize(5, 3);
    stray.X.row(4) << 0, 0, 100;
    const DistancesTo d = surface_distances(stray, square(4, 0)).a_to_b;
    EXPECT_TRUE(std::isnan(d.of_vertices[4]));
    EXPECT_NEAR(d.max, 0.5, 1e-15);
}

TEST(SurfaceDistance, HistogramHasSharesOfTheArea) {
    const TriangleMesh ramp{grid_mesh(2, 2, 1, 1).X * Eigen::AngleAxisd(-0.3, Vector3::UnitY()).toRotationMatrix().transpose(),
                            grid_mesh(2, 2, 1, 1).F};
    const DistancesTo d = surface_distances(ramp, square(6, 0)).a_to_b;
    const std::vector<double> shares = area_histogram(d, d.max, 4);
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-12);
    for (const double share : shares) EXPECT_NEAR(share, 0.25, 0.01);
    EXPECT_NEAR(area_histogram(surface_distances(square(1, 1), square(4, 0)).a_to_b, 1, 4).back(), 1, 1e-12);
    EXPECT_NEAR(area_histogram(surface_distances(ramp, ramp).a_to_b, 0, 4).front(), 1, 1e-12);
}

// The error of a mean contains what measuring four times as many pieces, or the closed form, makes of it.
TEST(SurfaceDistance, MeansKeepWithinTheirErrors) {
    const double angle = 0.3;
    const TriangleMesh ramp{grid_mesh(9, 9, 1, 1).X * Eigen::AngleAxisd(-angle, Vector3::UnitY()).toRotationMatrix().transpose(),
                            grid_mesh(9, 9, 1, 1).F};
    const DistancesTo d = surface_distances(ramp, square(6, 0)).a_to_b;
    EXPECT_LE(std::abs(d.mean - std::sin(angle) / 2), d.mean_error);
    EXPECT_LE(std::abs(d.rms - std::sin(angle) / std::sqrt(3)), d.rms_error);
    EXPECT_LT(d.mean_error, 0.05 * d.mean);
    for (const double factor : {1.001, 1.1, 3.0}) {
        const TriangleMesh a = irregular_sphere(2), b = scaled(cube_mesh(4), factor), fine_a = split_at_middles(split_at_middles(a));
        const DistancesTo coarse = surface_distances(a, b).a_to_b, fine = surface_distances(fine_a, b).a_to_b;
        EXPECT_LE(std::abs(coarse.mean - fine.mean), coarse.mean_error + fine.mean_error);
        EXPECT_LE(std::abs(coarse.rms - fine.rms), coarse.rms_error + fine.rms_error);
    }
    // Where the pieces are the triangles and far away, the error falls with the square of their size.
    const TriangleMesh inner = icosphere(6, 0.1);
    const DistancesTo far = surface_distances(inner, square(40, 5)).a_to_b;
    EXPECT_LT(far.mean_error, 1e-6 * far.mean);
    EXPECT_LT(far.rms_error, 1e-6 * far.rms);
}

}   // namespace
}   // namespace meshfolio
