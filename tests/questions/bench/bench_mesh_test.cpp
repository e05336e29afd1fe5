#include "questions/bench/bench_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "geometry/curvature/analytic_surfaces.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;

namespace {

constexpr std::array all_kinds{MeshKind::regular, MeshKind::jittered, MeshKind::random, MeshKind::noisy, MeshKind::anisotropic};

}   // namespace

TEST(BenchMesh, PointsLieOnTheSurfaceAndTrianglesLookOutwards) {
    for (const KnownSurface& s : known_surfaces()) {
        for (const MeshKind kind : all_kinds) {
            const BenchMesh t = bench_mesh(s, kind, 3, 1);
            const std::string where = s.name + ", " + std::string(name_of(kind));
            EXPECT_TRUE(t.topology.oriented_manifold) << where;
            const double off = kind == MeshKind::noisy ? 0.06 * t.mean_edge : 1e-13;
            for (const auto& p : t.mesh.X.rowwise()) EXPECT_LT((s.projected(p.transpose()) - p.transpose()).norm(), off) << where;
            const Positions faces = face_normals(t.mesh);
            int inwards = 0;
            for (int f = 0; f < t.mesh.face_count(); ++f) inwards += faces.row(f).dot(t.normals.row(t.mesh.F(f, 0))) > 0 ? 0 : 1;
            EXPECT_LE(inwards, kind == MeshKind::random ? 1 : 0) << where;
        }
    }
}

TEST(BenchMesh, EachLevelHalvesTheEdges) {
    for (const KnownSurface& s : known_surfaces()) {
        for (const MeshKind kind : all_kinds) {
            EXPECT_NEAR(bench_mesh(s, kind, 4, 1).mean_edge / bench_mesh(s, kind, 3, 1).mean_edge, 0.5, 0.04) << s.name;
        }
    }
}

TEST(BenchMesh, RandomIsIrregularAndAnisotropicIsStretched) {
    for (const KnownSurface& s : known_surfaces()) {
        const auto mean_longest_over_shortest = [&](MeshKind kind) {
            const CornerValues lengths = edge_lengths(bench_mesh(s, kind, 4, 1).mesh);
            return (lengths.rowwise().maxCoeff().array() / lengths.rowwise().minCoeff().array()).mean();
        };
        const auto valences = [&](MeshKind kind) {
            const MeshTopology topology = bench_mesh(s, kind, 4, 1).topology;
            std::set<int> found;
            for (int v = 0; v < static_cast<int>(topology.on_boundary.size()); ++v) {
                if (!topology.on_boundary[static_cast<std::size_t>(v)]) found.insert(topology.neighbours.size(v));
            }
            return found;
        };
        EXPECT_LE(valences(MeshKind::regular).size(), 2u) << s.name;
        EXPECT_GE(valences(MeshKind::random).size(), 4u) << s.name;
        EXPECT_GT(mean_longest_over_shortest(MeshKind::anisotropic), 1.4 * mean_longest_over_shortest(MeshKind::regular)) << s.name;
    }
}

TEST(BenchMesh, MeasuresTheSamePartOfTheSurfaceAtEveryLevel) {
    for (const KnownSurface& s : known_surfaces()) {
        const auto measured_share = [&](int level) {
            const BenchMesh t = bench_mesh(s, MeshKind::regular, level, 1);
            double inside = 0;
            for (std::size_t v = 0; v < t.measured.size(); ++v) inside += t.measured[v] ? t.areas[static_cast<Eigen::Index>(v)] : 0;
            return inside / t.areas.sum();
        };
        EXPECT_GT(measured_share(2), 0.15) << s.name;
        EXPECT_NEAR(measured_share(5), measured_share(6), 0.05) << s.name;
    }
}

TEST(BenchMesh, NormalsAreUnitVectorsNearThoseOfTheTriangles) {
    for (const KnownSurface& surface : known_surfaces()) {
        for (const MeshKind kind : {MeshKind::regular, MeshKind::jittered}) {
            const BenchMesh b = bench_mesh(surface, kind, 4, 1);
            EXPECT_LT((b.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
            const Positions triangle_normals = face_normals(b.mesh);
            for (int t = 0; t < b.mesh.face_count(); ++t) {   // no triangle has turned over
                ASSERT_GT(triangle_normals.row(t).dot(b.normals.row(b.mesh.F(t, 0))), 0.7) << surface.name << ", triangle " << t;
            }
        }
    }
}

TEST(BenchMesh, TotalCurvatureOfClosedSurfacesFollowsTheGenus) {
    for (const KnownSurface& surface : known_surfaces()) {
        const BenchMesh b = bench_mesh(surface, MeshKind::regular, 5, 1);
        if (b.topology.boundary_edge_count() > 0) continue;
        EXPECT_NEAR(b.K.dot(b.areas), surface.name == "torus" ? 0 : 4 * M_PI, 0.03) << surface.name;
    }
}

TEST(BenchMesh, JitterDependsOnTheSeedAlone) {
    const auto positions = [](std::uint64_t seed) { return bench_mesh(known_surface("torus"), MeshKind::jittered, 3, seed).mesh.X; };
    EXPECT_EQ(positions(1), positions(1));
    EXPECT_NE(positions(1), positions(2));
}

TEST(BenchMesh, JitterKeepsTheBoundaryAndItsBound) {
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

TEST(BenchMesh, MakesSharedValuesOnce) {
    const BenchMesh b = bench_mesh(known_surface("sphere"), MeshKind::regular, 1, 1);
    int made = 0;
    const auto make = [&] { return ++made; };
    EXPECT_EQ(b.shared("answer", make), 1);
    EXPECT_EQ(b.shared("answer", make), 1);
    EXPECT_EQ(b.shared("another", make), 2);
}
