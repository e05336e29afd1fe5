#include "questions/bench/mesh_class.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;

// An edge of three faces is sharp if one of them continues no other, whatever their orientation.
TEST(MeshClass, AFinMakesAnEdgeAFeature) {
    const TriangleMesh sheet = grid_mesh(5, 5, 1, 1);
    const auto features_with_third_vertex_at = [&](const Eigen::RowVector3d& place) {
        TriangleMesh mesh = sheet;
        mesh.X.conservativeResize(mesh.X.rows() + 1, 3);
        mesh.X.bottomRows(1) = place;
        mesh.F.conservativeResize(mesh.F.rows() + 1, 3);
        const MeshTopology topology = topology_of(sheet);
        const auto inner = std::ranges::find_if(topology.edges, [&](const Edge& e) { return e.faces == 2; });
        mesh.F.bottomRows(1) << inner->a, inner->b, static_cast<int>(mesh.X.rows()) - 1;
        return std::ranges::count(feature_vertices(mesh, topology_of(mesh)), 1);
    };
    EXPECT_EQ(std::ranges::count(feature_vertices(sheet, topology_of(sheet)), 1), 0);
    EXPECT_EQ(features_with_third_vertex_at({0.5, 0.5, 1}), 2) << "the ends of the edge that the fin stands on";
    EXPECT_EQ(features_with_third_vertex_at({0.6, 0.3, 0}), 0) << "folded flat onto the sheet";
}

// Sharp edges count too: otherwise smoothing would lower the median by changing the set of edges.
TEST(MeshClass, TheMedianFaceAngleIncludesAllEdges) {
    const TriangleMesh icosahedron = icosphere(0);
    EXPECT_NEAR(median_face_angle(icosahedron, topology_of(icosahedron)), 180 - 138.189685104221, 1e-9);
    EXPECT_EQ(mesh_character(icosahedron, topology_of(icosahedron)).typical_angle, 0) << "off the feature edges there is none";
}
