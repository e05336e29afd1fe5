#include "geometry/measures/local_thickness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

TEST(LocalThickness, OfABallIsItsDiameter) {
    const Vector thickness = local_thickness(scaled(icosphere(3), 2.5));
    EXPECT_GT(thickness.minCoeff(), 4.9);
    EXPECT_LT(thickness.maxCoeff(), 5.05);
}

TEST(LocalThickness, OfATorusIsThatOfItsTube) {
    const TriangleMesh mesh = moved_by(torus_mesh(64, 32, 1, 0.25), {5, 6, 7});
    const Vector thickness = local_thickness(mesh);
    for (const double t : thickness) EXPECT_NEAR(t, 0.5, 0.02);
}

TEST(LocalThickness, OfABoxIsThatAcross) {
    TriangleMesh mesh = cube_mesh(10);
    const Vector3 low = bounding_box(mesh).low, extent = bounding_box(mesh).extent();
    mesh.X.col(2) *= 0.1;
    int inside = 0;
    const Vector thickness = local_thickness(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double x = (mesh.X(v, 0) - low[0]) / extent[0], y = (mesh.X(v, 1) - low[1]) / extent[1];
        if (std::abs(x - 0.5) > 0.35 || std::abs(y - 0.5) > 0.35) continue;
        EXPECT_NEAR(thickness[v], 0.1 * extent[2], 1e-12);
        ++inside;
    }
    EXPECT_GT(inside, 20);
}

TEST(LocalThickness, AFlatSheetHasNone) {
    for (const double t : local_thickness(grid_mesh(5, 5, 1, 1))) EXPECT_TRUE(std::isnan(t));
    EXPECT_TRUE(std::isnan(local_thickness(with_unreferenced_vertex(icosphere(1), {0, 0, 9}))[0]));
}

TEST(LocalThickness, MeasuresSomeVerticesOfLargeMeshes) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const double n = mesh.vertex_count();
    const Vector all = local_thickness(mesh), some = local_thickness(mesh, n * n / 7);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (v % 7 == 0) {
            EXPECT_EQ(some[v], all[v]);
        } else {
            EXPECT_TRUE(std::isnan(some[v]));
        }
    }
}
