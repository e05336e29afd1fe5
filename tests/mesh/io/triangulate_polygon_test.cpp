#include "mesh/io/triangulate_polygon.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <random>

#include "base/errors.h"
#include "mesh/io/mesh_files.h"
#include "mesh/mesh_topology.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;
using std::numbers::pi;

namespace {

Positions polygon(const std::vector<std::array<double, 2>>& points) {
    Positions X(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) X.row(static_cast<Eigen::Index>(i)) << points[i][0], points[i][1], 0;
    return X;
}

Faces triangles_of(const Positions& corners) { return triangulated_polygon(corners).triangles; }

Vector3 area_vector(const Positions& X) {
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index i = 0; i < X.rows(); ++i) sum += 0.5 * X.row(i).cross(X.row((i + 1) % X.rows())).transpose();
    return sum;
}

/// Expects n − 2 triangles with the orientation, the area and the boundary of the polygon, which they tile then.
void expect_tiling(const Positions& X, double relative_error = 1e-12) {
    const PolygonTriangles cut = triangulated_polygon(X);
    EXPECT_TRUE(cut.simple);
    ASSERT_EQ(cut.triangles.rows(), X.rows() - 2);
    const TriangleMesh mesh{X.rowwise() - X.row(0), cut.triangles};
    const Vector3 area = area_vector(mesh.X);
    EXPECT_NEAR(surface_area(mesh), area.norm(), relative_error * area.norm());
    EXPECT_GE((face_normals(mesh) * area).minCoeff(), 0);
    const auto loops = boundary_loops(mesh);
    ASSERT_EQ(loops.size(), 1U);
    for (Eigen::Index i = 0; i < X.rows(); ++i) EXPECT_EQ(loops[0][static_cast<std::size_t>(i)], i);
}

/// Returns corners at increasing angles and any distance from a centre: simple, and mostly concave.
Positions random_star(int n, unsigned seed) {
    std::mt19937 bits(seed);
    std::vector<std::array<double, 2>> points;
    for (int i = 0; i < n; ++i) {
        const double radius = 0.05 + static_cast<double>(bits() % 1000) / 1000;
        points.push_back({radius * std::cos(2 * pi * i / n), radius * std::sin(2 * pi * i / n)});
    }
    return polygon(points);
}

/// Returns a band wound around itself, of which only few corners are ears at any time.
Positions spiral(int n) {
    std::vector<std::array<double, 2>> points;
    const auto add = [&](int i, double width) {
        const double angle = 0.05 * i;
        points.push_back({(angle + width) * std::cos(angle), (angle + width) * std::sin(angle)});
    };
    for (int i = 10; i < 10 + n / 2; ++i) add(i, 0);
    for (int i = 9 + n / 2; i >= 10; --i) add(i, 2);
    return polygon(points);
}

}   // namespace

TEST(TriangulatePolygon, ConvexPolygonsAreFans) {
    const Faces fan = triangles_of(polygon({{0, 0}, {2, 0}, {3, 1}, {1, 3}, {-1, 1}}));
    EXPECT_EQ(fan, (Faces(3, 3) << 0, 1, 2, 0, 2, 3, 0, 3, 4).finished());
}

TEST(TriangulatePolygon, ConcaveQuadIsCutInside) {
    expect_tiling(polygon({{0, 0}, {4, 4}, {0, 1}, {-4, 4}}));
    expect_tiling(polygon({{4, 4}, {0, 1}, {-4, 4}, {0, 0}}));
    expect_tiling(polygon({{0, 0}, {-4, 4}, {0, 1}, {4, 4}}));   // clockwise: normal −z
}

TEST(TriangulatePolygon, CornersOnAStraightEdgeGiveNoFlatTriangle) {
    const Positions X = polygon({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
    expect_tiling(X);
    EXPECT_GT(face_areas({X, triangles_of(X)}).minCoeff(), 0.4);
}

TEST(TriangulatePolygon, RandomConcavePolygonsAreTiled) {
    for (unsigned seed = 0; seed < 300; ++seed) expect_tiling(random_star(4 + static_cast<int>(seed % 40), seed));
}

TEST(TriangulatePolygon, NeitherPlaceNorSizeNorPlaneMatter) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        // Coordinates are multiples of 1/1024, so that moving them far away is exact.
        const Positions X = (random_star(17, seed) * 1024).array().round().matrix() / 1024;
        const Faces triangles = triangles_of(X);
        EXPECT_EQ(triangles_of(moved(X, {1e9, -1e9, 1e9})), triangles);
        EXPECT_EQ(triangles_of(moved(X, Vector3::Zero(), 0x1p-1060)), triangles);
        EXPECT_EQ(triangles_of(moved(X, Vector3::Zero(), 0x1p300)), triangles);
        expect_tiling(rotated(X));
    }
}

TEST(TriangulatePolygon, StartingElsewhereGivesTheSameArea) {
    const Positions X = random_star(31, 5);
    for (Eigen::Index shift = 1; shift < X.rows(); ++shift) {
        Positions turned(X.rows(), 3);
        turned << X.bottomRows(X.rows() - shift), X.topRows(shift);
        expect_tiling(turned);
    }
}

TEST(TriangulatePolygon, BridgeToAHole) {
    // A square with a square hole, joined by an edge walked twice.
    const Positions X = polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
    const PolygonTriangles cut = triangulated_polygon(X);
    EXPECT_TRUE(cut.simple);
    EXPECT_NEAR(face_areas({X, cut.triangles}).sum(), 12, 1e-12);
    EXPECT_GE(face_normals({X, cut.triangles}).col(2).minCoeff(), 0);
}

TEST(TriangulatePolygon, SpikesAreLeftOut) {
    const Positions square = polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    const auto expect_square = [&](const std::vector<std::array<double, 2>>& points, int spikes) {
        const PolygonTriangles cut = triangulated_polygon(polygon(points));
        EXPECT_TRUE(cut.simple);
        EXPECT_EQ(cut.spikes, spikes);
        EXPECT_EQ(cut.triangles.rows(), std::ssize(points) - 2 - spikes);
        EXPECT_NEAR(surface_area({polygon(points), cut.triangles}), 4, 1e-12);
        EXPECT_GT(face_areas({polygon(points), cut.triangles}).minCoeff(), 0);
    };
    expect_square({{0, 0}, {2, 0}, {3, 0}, {2, 0}, {2, 2}, {0, 2}}, 2);                    // out
    expect_square({{3, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 0}}, 2);                    // out, beginning at its end
    expect_square({{2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 0}, {3, 0}}, 2);                    // out, ending there
    expect_square({{0, 0}, {3, 0}, {2, 0}, {2, 2}, {0, 2}}, 1);                            // along an edge and back
    expect_square({{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, 2 - 1 + 1);    // in
    expect_square({{0, 0}, {2, 0}, {3, 1}, {4, 5}, {3, 1}, {2, 0}, {2, 2}, {0, 2}}, 4);    // out around a corner
    expect_square({{0, 0}, {2, 0}, {3, 0}, {3, 0}, {3, 0}, {2, 0}, {2, 2}, {0, 2}}, 4);    // with corners at one place
    expect_square({{0, 0}, {2, 0}, {0, 0}, {2, 0}, {0, 0}, {2, 0}, {2, 2}, {0, 2}}, 4);    // an edge walked five times
    expect_square({{0, 0}, {2, 0}, {3, 0}, {2, 0}, {2, -1}, {2, 0}, {2, 2}, {0, 2}}, 4);   // two of them at one corner
    EXPECT_EQ(triangulated_polygon(square).spikes, 0);
    EXPECT_FALSE(triangulated_polygon(polygon({{0, 0}, {1, 1}, {2, 2}, {1, 1}})).simple) << "nothing but a spike";
}

/// Returns the polygon with `count` spikes: at a corner, or in the middle of an edge, out and back to any distance, with one to three
/// corners on the way.
Positions with_spikes(const Positions& X, int count, unsigned seed) {
    std::mt19937 bits(seed);
    const auto random = [&](double low, double high) { return low + (high - low) * static_cast<double>(bits() % 4096) / 4096; };
    std::vector<Vector3> corners;
    for (const auto row : X.rowwise()) corners.emplace_back(row);
    for (int i = 0; i < count; ++i) {
        const auto place = static_cast<std::ptrdiff_t>(bits() % corners.size());
        const Vector3 a = corners[static_cast<std::size_t>(place)], b = corners[static_cast<std::size_t>(place + 1) % corners.size()];
        Vector3 way(random(-2, 2), random(-2, 2), 0);
        if (bits() % 2 == 0) way = (b - a) * random(0.1, 2);
        std::vector<Vector3> out{a + way};
        if (bits() % 2 == 0) out = {a + way / 2, a + way, a + way / 2};
        if (bits() % 4 == 0) out.push_back(a);
        if (bits() % 4 == 0) out.insert(out.begin(), a);
        if (out.back() != a && !way.cross(b - a).isZero()) out.push_back(a);
        corners.insert(corners.begin() + place + 1, out.begin(), out.end());
    }
    Positions result(std::ssize(corners), 3);
    for (Eigen::Index i = 0; i < result.rows(); ++i) result.row(i) = corners[static_cast<std::size_t>(i)];
    return result;
}

TEST(TriangulatePolygon, AreasOfPolygonsWithSpikesAreThoseOfNewell) {
    int tried = 0, crossing = 0;
    for (unsigned seed = 0; seed < 600; ++seed) {
        Positions X = with_spikes(random_star(4 + static_cast<int>(seed % 20), seed), 1 + static_cast<int>(seed % 5), seed);
        if (seed % 2 == 1) X = X.colwise().reverse().eval();
        const double area = area_vector(X).norm();
        for (const auto& [offset, scale] : {std::pair{0., 1.}, {0., 1e-9}, {0., 1e12}, {1e3, 1.}, {-1e6, 1.}}) {
            const Positions placed = (scale * rotated(X)).rowwise() + Eigen::RowVector3d(offset, 2 * offset, -offset);
            for (const double digits : {0., 1e6}) {   // as files round: not, or to six decimals
                if (digits > 0 && scale != 1) continue;
                const Positions written = digits > 0 ? Positions((placed * digits).array().round() / digits) : placed;
                const PolygonTriangles cut = triangulated_polygon(written);
                ++tried;
                // Rounding bends a spike; a few polygons then cross themselves, which is reported.
                const bool is_exact = digits == 0 && offset == 0;
                if (!is_exact && !cut.simple) {
                    ++crossing;
                    continue;
                }
                const double found = surface_area({written.rowwise() - written.row(0), cut.triangles}) / (scale * scale);
                const double error = digits > 0 ? 1e-4 : 1e-12 + 1e-14 * std::abs(offset);
                EXPECT_NEAR(found, area, error * (1 + area)) << seed << " " << offset << " " << scale << " " << digits;
            }
        }
    }
    EXPECT_LT(crossing, 0.03 * tried);
}

TEST(TriangulatePolygon, BridgesToSeveralHoles) {
    for (int holes = 1; holes <= 9; ++holes) {
        for (const bool clockwise : {false, true}) {
            std::vector<std::array<double, 2>> points{{0, 0}};
            for (int i = 0; i < holes; ++i) {   // every bridge begins at the corner (0, 0)
                const double x = 3 * i + 3, y = 30 - 3 * i;
                for (const auto& [dx, dy] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}}) points.push_back({x + dx, y + dy});
                points.push_back({0, 0});
            }
            for (const auto& corner : {std::array{40., 0.}, {40., 40.}, {0., 40.}}) points.push_back(corner);
            if (clockwise) std::ranges::reverse(points);
            const Positions X = polygon(points);
            EXPECT_NEAR(area_vector(X).norm(), 1600 - holes, 1e-9);
            const PolygonTriangles cut = triangulated_polygon(X);
            EXPECT_EQ(cut.spikes, 0);
            EXPECT_NEAR(surface_area({X, cut.triangles}), 1600 - holes, 1e-9) << holes << clockwise;
        }
    }
}

TEST(TriangulatePolygon, ManyCornersTakeNoMoreThanMoments) {
    expect_tiling(random_star(20000, 1), 1e-9);
    expect_tiling(spiral(20000), 1e-9);
}

// Many events may wake a waiting corner; checking it for each of them took minutes here.
TEST(TriangulatePolygon, ManyCornersInARowTakeNoMoreThanMoments) {
    constexpr int count = 16000;
    std::vector<std::array<double, 2>> wedge, strip;
    for (int i = 0; i < count - 1; ++i) wedge.push_back({double(i), 0});
    wedge.push_back({0, 1});
    for (int i = 0; i < count / 2; ++i) strip.push_back({double(i), 0});
    for (int i = count / 2; i-- > 0;) strip.push_back({double(i), 1});
    expect_tiling(polygon(wedge), 1e-9);
    expect_tiling(polygon(strip), 1e-9);
}

TEST(TriangulatePolygon, PolygonsThatAreNotSimpleStillGiveTriangles) {
    const PolygonTriangles bow_tie = triangulated_polygon(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
    EXPECT_FALSE(bow_tie.simple);
    EXPECT_EQ(bow_tie.triangles.rows(), 2);
    EXPECT_FALSE(triangulated_polygon(polygon({{0, 0}, {3, 3}, {3, 0}, {0, 1}})).simple);
    std::vector<std::array<double, 2>> pentagram;
    for (int i = 0; i < 5; ++i) pentagram.push_back({std::cos(0.8 * pi * i), std::sin(0.8 * pi * i)});
    EXPECT_FALSE(triangulated_polygon(polygon(pentagram)).simple);
    EXPECT_FALSE(triangulated_polygon(Positions::Zero(7, 3)).simple);
    EXPECT_EQ(triangulated_polygon(Positions::Zero(7, 3)).triangles.rows(), 5);
    std::mt19937 bits(3);
    Positions chaos(3000, 3);
    for (double& x : chaos.reshaped()) x = static_cast<double>(bits() % 4096);
    EXPECT_EQ(triangulated_polygon(chaos).triangles.rows(), 2998);
}

TEST(TriangulatePolygon, Limits) {
    EXPECT_THROW(triangles_of(Positions::Zero(2, 3)), MeshError);
    EXPECT_THROW(triangles_of(Positions::Zero(max_polygon_corners + 1, 3)), MeshError);
}
