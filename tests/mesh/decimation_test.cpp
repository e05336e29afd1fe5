#include "mesh/decimation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/errors.h"
#include "mesh/mesh_topology.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;

namespace {

int euler_number(const TriangleMesh& mesh) {
    return mesh.vertex_count() - static_cast<int>(topology_of(mesh).edges.size()) + mesh.face_count();
}

/// Returns the largest distance to the unit sphere, at the vertices and at the middles of the triangles.
double distance_to_sphere(const TriangleMesh& mesh) {
    double worst = 0;
    for (int t = 0; t < mesh.face_count(); ++t) {
        const Vector3 middle = (mesh.X.row(mesh.F(t, 0)) + mesh.X.row(mesh.F(t, 1)) + mesh.X.row(mesh.F(t, 2))) / 3;
        for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(mesh.X.row(mesh.F(t, k)).norm() - 1));
        worst = std::max(worst, std::abs(middle.norm() - 1));
    }
    return worst;
}

double wave(double x, double y) { return 0.1 * std::sin(5 * x) * std::cos(4 * y); }

}   // namespace

TEST(Decimation, ReachesTheRequestedNumber) {
    for (const int n : {600, 100, 12}) EXPECT_EQ(decimated(icosphere(4), n).vertex_count(), n);
    EXPECT_EQ(decimated(make_sample("creature"), 500).vertex_count(), 500);
    EXPECT_EQ(decimated(make_sample("fandisk_noisy"), 500).vertex_count(), 500);
}

TEST(Decimation, AClosedManifoldStaysOneAndKeepsItsEulerCharacteristic) {
    for (const TriangleMesh& mesh : {icosphere(3), torus_mesh(40, 20, 2, 0.7), make_sample("creature"), make_sample("fandisk_like")}) {
        const TriangleMesh small = decimated(mesh, 300);
        const MeshTopology topology = topology_of(small);
        EXPECT_TRUE(topology.oriented_manifold);
        EXPECT_EQ(topology.boundary_edge_count(), 0);
        EXPECT_EQ(topology.component_count, 1);
        EXPECT_EQ(euler_number(small), euler_number(mesh));
        EXPECT_GT(signed_volume(small), 0);
    }
}

// Fewer vertices are requested than the topology needs: four for a sphere (a tetrahedron), seven for a torus.
TEST(Decimation, StopsWhereTheTopologyWouldChange) {
    EXPECT_EQ(decimated(meshfolio::testing::tetrahedron(), 4).face_count(), 4);
    const TriangleMesh torus = decimated(torus_mesh(12, 8, 2, 0.7), 4);
    EXPECT_GE(torus.vertex_count(), 7);
    EXPECT_EQ(euler_number(torus), 0);
}

TEST(Decimation, TheBoundaryOfAPlateKeepsItsCornersAndItsPlace) {
    const TriangleMesh plate = grid_mesh(30, 20, 3, 2, wave), small = decimated(plate, 150);
    EXPECT_EQ(boundary_loops(small).size(), 1u);
    EXPECT_EQ(euler_number(small), 1);
    const TriangleMesh flat = decimated(grid_mesh(30, 20, 3, 2), 60);
    EXPECT_NEAR(surface_area(flat), 6, 6e-3);
    for (const auto& loop : boundary_loops(flat)) {
        for (const int v : loop) {
            const double x = flat.X(v, 0), y = flat.X(v, 1);
            EXPECT_LT(std::min({std::abs(x), std::abs(x - 3), std::abs(y), std::abs(y - 2)}), 0.01) << x << ' ' << y;
        }
    }
}

TEST(Decimation, EdgesOfACubeStay) {
    const TriangleMesh cube = decimated(cube_mesh(10), 60);
    EXPECT_NEAR(signed_volume(cube), 1, 0.01);
    EXPECT_NEAR(surface_area(cube), 6, 0.05);
}

TEST(Decimation, TheErrorFallsAsTheSizeGrows) {
    const TriangleMesh sphere = icosphere(5);
    double before = 1;
    for (const int n : {50, 200, 800, 3200}) {
        const double now = distance_to_sphere(decimated(sphere, n));
        EXPECT_LT(now, 0.5 * before) << n;   // quadratic in the edge, which halves: a fourth
        before = now;
    }
}

TEST(Decimation, IsTheSameTwiceAndAfterScalingAndMoving) {
    const TriangleMesh mesh = make_sample("creature");
    const TriangleMesh once = decimated(mesh, 400), again = decimated(mesh, 400);
    EXPECT_EQ(once.X, again.X);
    EXPECT_EQ(once.F, again.F);
    const TriangleMesh large = decimated(moved_to(mesh, mesh.X * 0x1p300), 400);
    EXPECT_EQ(large.F, once.F);
    EXPECT_EQ(large.X, once.X * 0x1p300);
}

TEST(Decimation, LeavesASmallMeshAloneAndRefusesTooFew) {
    const TriangleMesh mesh = icosphere(1);
    const TriangleMesh same = decimated(mesh, mesh.vertex_count());
    EXPECT_EQ(same.F, mesh.F);
    EXPECT_LT((same.X - mesh.X).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_THROW(static_cast<void>(decimated(mesh, 3)), MeshError);
}

/// Separate triangles keep their corners for any requested number.
TEST(Decimation, ACopyThatCannotBeSmallIsRefused) {
    constexpr int triangles = 100;
    TriangleMesh mesh{Positions::Random(3 * triangles, 3), Faces(triangles, 3)};
    for (int t = 0; t < triangles; ++t) mesh.F.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    EXPECT_EQ(decimated(mesh, 10).vertex_count(), 3 * triangles);
    EXPECT_THROW(static_cast<void>(small_copy(mesh, 10)), MeshError);
    EXPECT_EQ(small_copy(mesh, 75).vertex_count(), 3 * triangles);   // four times as many
    EXPECT_LE(small_copy(icosphere(3), 50).vertex_count(), 50);
}

TEST(Decimation, NonManifoldVerticesStay) {
    // Two fans of a perturbed sphere touch in one point, which does not move.
    TriangleMesh sphere = icosphere(2);
    const int n = sphere.vertex_count(), m = sphere.face_count();
    TriangleMesh two{Positions(2 * n, 3), Faces(2 * m, 3)};
    two.X << sphere.X, (-sphere.X).rowwise() + 2 * sphere.X.row(0);
    two.F << sphere.F, sphere.F.array() + n;
    for (int t = m; t < 2 * m; ++t) {
        for (int k = 0; k < 3; ++k) two.F(t, k) = two.F(t, k) == n ? 0 : two.F(t, k);
    }
    const TriangleMesh small = decimated(two, 60);
    EXPECT_EQ(topology_of(small).nonmanifold_vertex_count(), 1);
    double nearest = 1;
    for (int v = 0; v < small.vertex_count(); ++v) nearest = std::min(nearest, (small.X.row(v) - sphere.X.row(0)).norm());
    EXPECT_LT(nearest, 1e-12);
}

TEST(SurfacePatch, ASmallMeshIsTakenWhole) {
    const TriangleMesh mesh = icosphere(2);
    const CompactMesh patch = surface_patch(mesh, topology_of(mesh), 5, mesh.vertex_count());
    EXPECT_EQ(patch.mesh.X, mesh.X);
    EXPECT_EQ(patch.mesh.F, mesh.F);
    EXPECT_EQ(patch.original[7], 7);
}

TEST(SurfacePatch, OneRingIsAllTrianglesAroundTheVertex) {
    const TriangleMesh mesh = icosphere(2);
    const MeshTopology topology = topology_of(mesh);
    const CompactMesh patch = surface_patch(mesh, topology, 100, 1 + topology.neighbours.size(100));
    EXPECT_EQ(patch.mesh.face_count(), topology.vertex_faces.size(100));
    EXPECT_EQ(patch.mesh.vertex_count(), 1 + topology.neighbours.size(100));
}

TEST(SurfacePatch, IsAConnectedPartOfTheMeshAroundTheVertex) {
    const TriangleMesh mesh = icosphere(4);
    const CompactMesh patch = surface_patch(mesh, topology_of(mesh), 1000, 300);
    EXPECT_LE(patch.mesh.vertex_count(), 300);
    EXPECT_GT(patch.mesh.vertex_count(), 280);
    EXPECT_EQ(topology_of(patch.mesh).component_count, 1);
    bool has_it = false;
    for (int i = 0; i < patch.mesh.vertex_count(); ++i) {
        EXPECT_EQ(patch.mesh.X.row(i), mesh.X.row(patch.original[i]));
        has_it = has_it || patch.original[i] == 1000;
    }
    EXPECT_TRUE(has_it);
    // The 300 of 2562 vertices of the unit sphere that are nearest to one form a cap.
    for (int i = 0; i < patch.mesh.vertex_count(); ++i) EXPECT_GT(patch.mesh.X.row(i).dot(mesh.X.row(1000)), 0.6);
}

TEST(SurfacePatch, NoSuchVertexIsRefused) {
    const TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(surface_patch(mesh, topology_of(mesh), mesh.vertex_count(), 10), MeshError);
    EXPECT_THROW(surface_patch(mesh, topology_of(mesh), -1, 10), MeshError);
}
