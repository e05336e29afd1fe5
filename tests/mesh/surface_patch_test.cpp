#include "mesh/surface_patch.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;

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
    // On the unit sphere 300 of 2562 vertices nearest to one are a cap.
    for (int i = 0; i < patch.mesh.vertex_count(); ++i) EXPECT_GT(patch.mesh.X.row(i).dot(mesh.X.row(1000)), 0.6);
}

TEST(SurfacePatch, NoSuchVertexIsRefused) {
    const TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(surface_patch(mesh, topology_of(mesh), mesh.vertex_count(), 10), MeshError);
    EXPECT_THROW(surface_patch(mesh, topology_of(mesh), -1, 10), MeshError);
}
