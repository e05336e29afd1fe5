#include "mesh/mesh_topology.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/errors.h"
#include "mesh/random_triangles.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

int euler(const TriangleMesh& mesh) { return mesh.vertex_count() - static_cast<int>(edges_of(mesh).size()) + mesh.face_count(); }

TriangleMesh faces_only(int vertices, const std::vector<std::array<int, 3>>& triangles) {
    TriangleMesh mesh = mesh_of({}, triangles);
    mesh.X = Positions::Zero(vertices, 3);
    return mesh;
}

}   // namespace

TEST(MeshTopology, EulerCharacteristicOfSphereTorusDiscAndStrip) {
    EXPECT_EQ(euler(tetrahedron()), 2);
    EXPECT_EQ(euler(unit_cube()), 2);
    EXPECT_EQ(euler(torus(7, 5)), 0);
    EXPECT_EQ(euler(flat_grid(4, 6)), 1);
    EXPECT_EQ(euler(moebius_strip(9)), 0);
}

TEST(MeshTopology, EdgesAreSortedAndCountTheirTriangles) {
    const MeshTopology topology = topology_of(flat_grid(3, 3));
    int sides = 0;
    for (std::size_t i = 0; i < topology.edges.size(); ++i) {
        const Edge& e = topology.edges[i];
        EXPECT_LT(e.a, e.b);
        sides += e.faces;
        if (i == 0) continue;
        EXPECT_LT(std::pair(topology.edges[i - 1].a, topology.edges[i - 1].b), std::pair(e.a, e.b));
    }
    EXPECT_EQ(sides, 3 * 8);
    EXPECT_EQ(topology.boundary_edge_count(), 8);
}

TEST(MeshTopology, RowsAgreeWithTheFaces) {
    const TriangleMesh mesh = torus(6, 5);
    const MeshTopology topology = topology_of(mesh);
    std::vector<std::set<int>> faces(30), ring(30);
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            faces[static_cast<std::size_t>(mesh.F(t, k))].insert(t);
            ring[static_cast<std::size_t>(mesh.F(t, k))].insert({mesh.F(t, (k + 1) % 3), mesh.F(t, (k + 2) % 3)});
        }
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto row = [v](const Incidence& incidence) { return std::vector<int>(incidence.begin(v), incidence.end(v)); };
        EXPECT_EQ(row(topology.vertex_faces),
                  std::vector<int>(faces[static_cast<std::size_t>(v)].begin(), faces[static_cast<std::size_t>(v)].end()));
        EXPECT_EQ(row(topology.neighbours),
                  std::vector<int>(ring[static_cast<std::size_t>(v)].begin(), ring[static_cast<std::size_t>(v)].end()));
        EXPECT_EQ(topology.neighbours.size(v), 6);
    }
}

TEST(MeshTopology, IsTheSameForAnyNumberOfThreads) {
    const auto all_of = [](const TriangleMesh& mesh) {
        const MeshTopology t = topology_of(mesh);
        std::vector<int> edges;
        for (const Edge& e : t.edges) edges.insert(edges.end(), {e.a, e.b, e.faces});
        return std::tuple(edges, t.vertex_faces.start, t.vertex_faces.item, t.neighbours.start, t.neighbours.item, t.on_boundary,
                          t.nonmanifold, t.component, t.component_count, t.oriented_manifold);
    };
    for (const TriangleMesh& mesh : {torus(300, 150), flat_grid(210, 230), random_triangles(60'000, 70'000, 1)}) {
        const auto many = all_of(mesh);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_TRUE(many == all_of(mesh));
    }
}

TEST(MeshTopology, EdgesAndComponentsOfManyRandomTriangles) {
    const TriangleMesh mesh = random_triangles(60'000, 40'000, 2);   // many small components, some large
    const MeshTopology topology = topology_of(mesh);
    std::map<std::pair<int, int>, int> edges;
    std::vector<int> component(40'000, -1);
    std::vector<std::vector<int>> around(60'000);
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            ++edges[std::minmax({mesh.F(t, k), mesh.F(t, (k + 1) % 3)})];
            around[static_cast<std::size_t>(mesh.F(t, k))].push_back(t);
        }
    }
    int count = 0;
    for (int first = 0; first < mesh.face_count(); ++first) {
        if (component[static_cast<std::size_t>(first)] >= 0) continue;
        std::vector<int> reached{first};
        component[static_cast<std::size_t>(first)] = count;
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (int k = 0; k < 3; ++k) {
                for (const int t : around[static_cast<std::size_t>(mesh.F(reached[i], k))]) {
                    if (component[static_cast<std::size_t>(t)] < 0) reached.push_back(t);
                    component[static_cast<std::size_t>(t)] = count;
                }
            }
        }
        ++count;
    }
    EXPECT_EQ(topology.component, component);
    EXPECT_EQ(topology.component_count, count);
    ASSERT_EQ(topology.edges.size(), edges.size());
    auto edge = topology.edges.begin();
    for (const auto& [ends, faces] : edges) {
        EXPECT_TRUE(edge->a == ends.first && edge->b == ends.second && edge->faces == faces);
        ++edge;
    }
    const std::vector<Edge> alone = edges_of(mesh);
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), topology.edges.begin(), topology.edges.end(),
                           [](const Edge& e, const Edge& f) { return e.a == f.a && e.b == f.b && e.faces == f.faces; }));
}

TEST(MeshTopology, OrientedManifoldsAreKnown) {
    for (const TriangleMesh& mesh : {tetrahedron(), torus(7, 5), flat_grid(4, 6)}) EXPECT_TRUE(topology_of(mesh).oriented_manifold);
    TriangleMesh turned = torus(7, 5);
    std::swap(turned.F(11, 0), turned.F(11, 1));
    const TriangleMesh pillow = faces_only(3, {{0, 1, 2}, {2, 1, 0}}), twice = faces_only(3, {{0, 1, 2}, {1, 2, 0}});
    const TriangleMesh bow_tie = faces_only(5, {{0, 1, 2}, {0, 3, 4}});
    for (const TriangleMesh& mesh : {turned, moebius_strip(9), pillow, twice, bow_tie}) EXPECT_FALSE(topology_of(mesh).oriented_manifold);
}

TEST(MeshTopology, BoundaryFlags) {
    const MeshTopology grid = topology_of(flat_grid(4, 5));
    EXPECT_EQ(std::count(grid.on_boundary.begin(), grid.on_boundary.end(), 1), 2 * 3 + 2 * 4);
    const MeshTopology closed = topology_of(torus(5, 4));
    EXPECT_EQ(std::count(closed.on_boundary.begin(), closed.on_boundary.end(), 1), 0);
}

TEST(MeshTopology, ThreePagesOnOneEdgeAreNonManifold) {
    const MeshTopology topology = topology_of(faces_only(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    EXPECT_EQ(topology.nonmanifold_edge_count(), 1);
    EXPECT_EQ(topology.nonmanifold, (std::vector<char>{1, 1, 0, 0, 0}));
}

TEST(MeshTopology, TwoTrianglesAtAPointAreABowTie) {
    const MeshTopology topology = topology_of(faces_only(5, {{0, 1, 2}, {0, 3, 4}}));
    EXPECT_EQ(topology.nonmanifold, (std::vector<char>{1, 0, 0, 0, 0}));
    EXPECT_EQ(topology.nonmanifold_edge_count(), 0);
    EXPECT_EQ(topology.component_count, 1);
    const MeshTopology fan = topology_of(faces_only(5, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
    EXPECT_EQ(fan.nonmanifold_vertex_count(), 0);
}

TEST(MeshTopology, ComponentsAreNumberedByTheirFirstTriangle) {
    const MeshTopology topology = topology_of(faces_only(10, {{7, 8, 9}, {0, 1, 2}, {9, 6, 7}, {1, 2, 3}}));
    EXPECT_EQ(topology.component, (std::vector<int>{0, 1, 0, 1}));
    EXPECT_EQ(topology.component_count, 2);
    EXPECT_EQ(topology_of(joined(torus(5, 4), tetrahedron())).component_count, 2);
}

TEST(MeshTopology, RefusesTrianglesWithoutThreeVertices) {
    EXPECT_THROW(topology_of(faces_only(3, {{0, 1, 1}})), MeshError);
    EXPECT_THROW(topology_of(faces_only(3, {{0, 1, 3}})), MeshError);
    EXPECT_THROW(topology_of(faces_only(3, {{0, 1, -1}})), MeshError);
}

TEST(BoundaryLoops, RunWithTheSurfaceToTheirLeft) {
    EXPECT_EQ(boundary_loops(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2, 0}})), (std::vector<std::vector<int>>{{0, 1, 2}}));
    const auto loops = boundary_loops(flat_grid(3, 3));   // vertex (i, j) at x = i, y = j is row 3 i + j
    EXPECT_EQ(loops, (std::vector<std::vector<int>>{{0, 3, 6, 7, 8, 5, 2, 1}}));
}

TEST(BoundaryLoops, OneForEachHole) {
    EXPECT_TRUE(boundary_loops(torus(5, 4)).empty());
    TriangleMesh pierced = torus(8, 7);
    pierced.F = pierced.F.bottomRows(pierced.face_count() - 1).eval();
    EXPECT_EQ(boundary_loops(pierced).size(), 1U);
    const auto cylinder = boundary_loops(TriangleMesh{Positions::Zero(12, 3), grid_faces(4, 3, true, false)});
    ASSERT_EQ(cylinder.size(), 2U);
    EXPECT_EQ(cylinder[0].size(), 4U);
    EXPECT_EQ(cylinder[1].size(), 4U);
    EXPECT_EQ(boundary_loops(moebius_strip(9)).size(), 1U);
    EXPECT_EQ(boundary_loops(moebius_strip(9))[0].size(), 18U);
}

TEST(BoundaryLoops, TouchingLoopsAreDistinguished) {
    EXPECT_EQ(boundary_loops(faces_only(5, {{0, 1, 2}, {0, 3, 4}})), (std::vector<std::vector<int>>{{0, 1, 2}, {0, 3, 4}}));
}

TEST(BoundaryLoops, EveryBoundaryEdgeIsInOneLoopEvenWhereTheSurfaceBranches) {
    for (const TriangleMesh& mesh :
         {faces_only(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), faces_only(4, {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {3, 1, 0}})}) {
        std::size_t vertices = 0;
        const auto loops = boundary_loops(mesh);
        for (const auto& loop : loops) vertices += loop.size();
        EXPECT_GE(vertices + loops.size(), static_cast<std::size_t>(topology_of(mesh).boundary_edge_count()));
    }
}
