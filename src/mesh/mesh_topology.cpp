#include "mesh/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/large_pages.h"
#include "base/parallel.h"
#include "mesh/vertex_fans.h"

namespace meshfolio {

namespace {

void check_faces(const TriangleMesh& mesh) {
    const auto is_sound = [&](int t) {
        const int a = mesh.F(t, 0), b = mesh.F(t, 1), c = mesh.F(t, 2);
        return std::min({a, b, c}) >= 0 && std::max({a, b, c}) < mesh.vertex_count() && a != b && b != c && c != a;
    };
    if (all_of_range(mesh.face_count(), is_sound)) return;
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.F(t, k);
            if (v >= 0 && v < mesh.vertex_count() && v != mesh.F(t, (k + 1) % 3)) continue;
            throw MeshError("topology_of: triangle " + std::to_string(t) + " names a vertex twice or one that does not exist (" +
                                std::to_string(v) + ", the mesh has " + std::to_string(mesh.vertex_count()) + ")",
                            "prepare_mesh drops such triangles");
        }
    }
}

/// For each vertex a, the ends b > a of its triangles' edges are sorted; equal ones are one edge.
std::vector<Edge> collected_edges(const TriangleMesh& mesh, const Incidence& vertex_faces) {
    std::vector<Edge> edges;
    edges.reserve(at(mesh.face_count()) * 3 / 2 + at(mesh.vertex_count()) / 8);
    std::vector<int> ends;
    for (int a = 0; a < mesh.vertex_count(); ++a) {
        ends.clear();
        for (const int* t = vertex_faces.begin(a); t != vertex_faces.end(a); ++t) {
            for (int k = 0; k < 3; ++k)
                if (mesh.F(*t, k) > a) ends.push_back(mesh.F(*t, k));
        }
        std::sort(ends.begin(), ends.end());
        for (const int b : ends)
            if (!edges.empty() && edges.back().a == a && edges.back().b == b)
                ++edges.back().faces;
            else
                edges.push_back({a, b, 1});
    }
    return edges;
}

/// Fills what can be told of each vertex alone.
void look_at_fans(const TriangleMesh& mesh, MeshTopology& topology) {
    const int vertices = mesh.vertex_count();
    topology.on_boundary.resize(at(vertices));
    topology.nonmanifold.resize(at(vertices));
    const auto regular = of_blocks(vertices, [&](int begin, int end) {
        FanReader fans(mesh, topology.vertex_faces);
        bool all = true;
        for (int v = begin; v < end; ++v) {
            const FanFacts facts = fans.facts(v);
            topology.on_boundary[at(v)] = facts.on_boundary ? 1 : 0;
            topology.nonmanifold[at(v)] = facts.nonmanifold ? 1 : 0;
            all &= facts.regular;
        }
        return all;
    });
    topology.oriented_manifold = std::all_of(regular.begin(), regular.end(), [](const auto& block) { return block.value; });
}

/// Joins the corners of each triangle on all processors, and numbers the sets in the order of their first triangles.
void label_components(const TriangleMesh& mesh, MeshTopology& topology) {
    DisjointSets sets(mesh.vertex_count());
    for_each_index(mesh.face_count(), [&](int t) {
        sets.join(mesh.F(t, 0), mesh.F(t, 1));
        sets.join(mesh.F(t, 1), mesh.F(t, 2));
    });
    topology.component = large_vector<int>(at(mesh.face_count()));
    if (mesh.face_count() == 0) return;
    topology.component_count = 1;
    const int first = sets.find(mesh.F(0, 0));
    if (all_of_range(mesh.face_count(), [&](int t) { return sets.find(mesh.F(t, 0)) == first; })) return;
    topology.component_count = 0;
    std::vector<int> label(at(mesh.vertex_count()), -1);   // of each smallest member
    for (int t = 0; t < mesh.face_count(); ++t) {
        int& of_set = label[at(sets.find(mesh.F(t, 0)))];
        if (of_set < 0) of_set = topology.component_count++;
        topology.component[at(t)] = of_set;
    }
}

template <class Items, class Condition>
int count_where(const Items& items, Condition condition) {
    return static_cast<int>(std::count_if(items.begin(), items.end(), condition));
}

}   // namespace

// Each half of the triangles is counted and placed by itself: what the first has of a row stands before what the second has.
Incidence triangles_around(const TriangleMesh& mesh) {
    constexpr int halves = 2;
    std::array<std::vector<int>, halves> next;   // of each row
    const auto for_each_corner = [&](int half, const auto& visit) {
        const auto begin = static_cast<int>(std::int64_t{half} * mesh.face_count() / halves);
        const auto end = static_cast<int>(std::int64_t{half + 1} * mesh.face_count() / halves);
        std::vector<int>& of_row = next[at(half)];
        for (int t = begin; t < end; ++t)
            for (int k = 0; k < 3; ++k) visit(of_row[at(mesh.F(t, k))], t);
    };
    tbb::parallel_for(0, halves, [&](int half) {
        next[at(half)] = large_vector<int>(at(mesh.vertex_count()));
        for_each_corner(half, [](int& count, int) { ++count; });
    });
    Incidence around;
    around.start = large_vector<int>(at(mesh.vertex_count()) + 1);
    for (int v = 0, sum = 0; v < mesh.vertex_count(); ++v) {
        for (std::vector<int>& of_row : next) sum += std::exchange(of_row[at(v)], sum);
        around.start[at(v) + 1] = sum;
    }
    around.item = large_vector<int>(at(mesh.face_count()) * 3);
    tbb::parallel_for(0, halves, [&](int half) { for_each_corner(half, [&](int& place, int t) { around.item[at(place++)] = t; }); });
    return around;
}

std::vector<Edge> edges_of(const TriangleMesh& mesh) { return collected_edges(mesh, triangles_around(mesh)); }

MeshTopology topology_without_edges(const TriangleMesh& mesh) {
    MeshTopology topology;
    topology.vertex_faces = triangles_around(mesh);
    look_at_fans(mesh, topology);
    label_components(mesh, topology);
    return topology;
}

MeshTopology with_edges(MeshTopology topology, const TriangleMesh& mesh) {
    topology.edges = collected_edges(mesh, topology.vertex_faces);
    Incidence& ring = topology.neighbours;
    ring.start.assign(at(mesh.vertex_count()) + 1, 0);
    for (const Edge& e : topology.edges) ++ring.start[at(e.a) + 1], ++ring.start[at(e.b) + 1];
    std::partial_sum(ring.start.begin(), ring.start.end(), ring.start.begin());
    ring.item = large_vector<int>(2 * topology.edges.size());
    std::vector<int> next(ring.start.begin(), ring.start.end() - 1);
    for (const Edge& e : topology.edges) {   // sorted, so that each row comes out ascending
        ring.item[at(next[at(e.a)]++)] = e.b;
        ring.item[at(next[at(e.b)]++)] = e.a;
    }
    return topology;
}

MeshTopology topology_of(const TriangleMesh& mesh) {
    check_faces(mesh);
    return with_edges(topology_without_edges(mesh), mesh);
}

int MeshTopology::boundary_edge_count() const {
    return count_where(edges, [](const Edge& e) { return e.faces == 1; });
}

int MeshTopology::nonmanifold_edge_count() const {
    return count_where(edges, [](const Edge& e) { return e.faces > 2; });
}

int MeshTopology::nonmanifold_vertex_count() const {
    return count_where(nonmanifold, [](char flag) { return flag != 0; });
}

}   // namespace meshfolio
