#include "questions/bench/known_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;

TEST(KnownSurfaces, VerticesLieOnTheSurfaceWhereverTheyAreMoved) {
    for (const KnownSurface& surface : known_surfaces()) {
        for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
            const SampledSurface s = sampled(surface, 3, triangulation, 1);
            for (const auto& p : s.mesh.X.rowwise())
                EXPECT_LT((surface.projected(p.transpose()) - p.transpose()).norm(), 1e-14) << surface.name;
        }
    }
}

TEST(KnownSurfaces, NormalsAreUnitAndThoseOfTheTriangles) {
    for (const KnownSurface& surface : known_surfaces()) {
        for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
            const SampledSurface s = sampled(surface, 4, triangulation, 1);
            EXPECT_LT((s.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
            const Positions triangle_normals = face_normals(s.mesh);
            for (int t = 0; t < s.mesh.face_count(); ++t) {   // no triangle has turned over
                ASSERT_GT(triangle_normals.row(t).dot(s.normals.row(s.mesh.F(t, 0))), 0.7) << surface.name << ", triangle " << t;
            }
        }
    }
}

TEST(KnownSurfaces, TotalCurvatureIsThatOfTheGenus) {
    for (const KnownSurface& surface : known_surfaces()) {
        const SampledSurface s = sampled(surface, 5, Triangulation::regular, 1);
        EXPECT_NEAR(s.K.dot(s.areas), surface.name == "torus" ? 0 : 4 * M_PI, 0.03) << surface.name;
    }
}

TEST(KnownSurfaces, JitterIsTheSameForTheSameSeedAndOtherForAnother) {
    const KnownSurface torus = known_surfaces()[2];
    const auto positions = [&](std::uint64_t seed) { return sampled(torus, 3, Triangulation::jittered, seed).mesh.X; };
    EXPECT_EQ(positions(1), positions(1));
    EXPECT_NE(positions(1), positions(2));
}

TEST(KnownSurfaces, JitterKeepsTheBoundaryAndItsBound) {
    const TriangleMesh grid = grid_mesh(9, 9, 1, 1);
    const MeshTopology topology = topology_of(grid);
    const Positions X = jittered(grid, topology, 0.2, 1, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    for (int i = 0; i < grid.vertex_count(); ++i) {
        const double moved = (X.row(i) - grid.X.row(i)).cwiseAbs().maxCoeff();
        if (topology.on_boundary[static_cast<std::size_t>(i)]) {
            EXPECT_EQ(moved, 0);
        } else {
            EXPECT_GT(moved, 0);
            EXPECT_LE(moved, 0.2 / 8 * (1 + 1e-12));
        }
    }
}

TEST(KnownSurfaces, FittedOrderIsTheExponentOfTheFinestThree) {
    EXPECT_NEAR(fitted_order({1, 0.5, 0.25}, {3, 0.75, 0.1875}), 2, 1e-12);
    EXPECT_NEAR(fitted_order({2, 1, 0.5, 0.25}, {1e9, 3, 1.5, 0.75}), 1, 1e-12);   // the coarsest is left out
    EXPECT_NEAR(fitted_order({1, 0.5}, {1, 1}), 0, 1e-12);
    EXPECT_TRUE(std::isnan(fitted_order({1}, {1})));
    EXPECT_TRUE(std::isnan(fitted_order({1, 0.5}, {0, 0})));
}
