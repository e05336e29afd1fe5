#include "mesh/mesh_topology.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "errors.h"

namespace meshfolio {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

void check_faces(const TriangleMesh& mesh) {
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
            for (int k = 0; k < 3; ++k) {
                if (mesh.F(*t, k) > a) ends.push_back(mesh.F(*t, k));
            }
        }
        std::sort(ends.begin(), ends.end());
        for (const int b : ends) {
            if (!edges.empty() && edges.back().a == a && edges.back().b == b) {
                ++edges.back().faces;
            } else {
                edges.push_back({a, b, 1});
            }
        }
    }
    return edges;
}

/// Both ends of every edge. The edges are sorted by (a, b), so every row comes out ascending: first the a < v, then the b > v.
Incidence one_rings(int vertices, const std::vector<Edge>& edges) {
    Incidence ring;
    ring.start.assign(at(vertices) + 1, 0);
    for (const Edge& e : edges) {
        ++ring.start[at(e.a) + 1];
        ++ring.start[at(e.b) + 1];
    }
    std::partial_sum(ring.start.begin(), ring.start.end(), ring.start.begin());
    ring.item.resize(edges.size() * 2);
    std::vector<int> next(ring.start.begin(), ring.start.end() - 1);
    for (const Edge& e : edges) {
        ring.item[at(next[at(e.a)]++)] = e.b;
        ring.item[at(next[at(e.b)]++)] = e.a;
    }
    return ring;
}

/// Disjoint sets of the integers below n; the smallest member stands for its set.
class DisjointSets {
public:
    void reset(int n) {
        parent_.resize(at(n));
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
        return i;
    }
    bool join(int i, int j) {
        const int a = find(i);
        const int b = find(j);
        parent_[at(std::max(a, b))] = std::min(a, b);
        return a != b;
    }

private:
    std::vector<int> parent_;
};

/// Whether the triangles around v, joined through the edges at v, fall apart: its link is not connected.
bool several_fans(const TriangleMesh& mesh, const MeshTopology& topology, int v, DisjointSets& sets) {
    const int* first = topology.neighbours.begin(v);
    const int* last = topology.neighbours.end(v);
    const auto place = [&](int w) { return static_cast<int>(std::lower_bound(first, last, w) - first); };
    int parts = topology.neighbours.size(v);
    sets.reset(parts);
    for (const int* t = topology.vertex_faces.begin(v); t != topology.vertex_faces.end(v); ++t) {
        const int k = mesh.F(*t, 0) == v ? 0 : mesh.F(*t, 1) == v ? 1 : 2;
        parts -= sets.join(place(mesh.F(*t, (k + 1) % 3)), place(mesh.F(*t, (k + 2) % 3)));
    }
    return parts > 1;
}

void flag_vertices(const TriangleMesh& mesh, MeshTopology& topology) {
    topology.on_boundary.assign(at(mesh.vertex_count()), 0);
    topology.nonmanifold.assign(at(mesh.vertex_count()), 0);
    for (const Edge& e : topology.edges) {
        if (e.faces == 1) topology.on_boundary[at(e.a)] = topology.on_boundary[at(e.b)] = 1;
        if (e.faces > 2) topology.nonmanifold[at(e.a)] = topology.nonmanifold[at(e.b)] = 1;
    }
    DisjointSets sets;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (several_fans(mesh, topology, v, sets)) topology.nonmanifold[at(v)] = 1;
    }
}

void label_components(const TriangleMesh& mesh, MeshTopology& topology) {
    DisjointSets sets;
    sets.reset(mesh.vertex_count());
    for (int t = 0; t < mesh.face_count(); ++t) {
        sets.join(mesh.F(t, 0), mesh.F(t, 1));
        sets.join(mesh.F(t, 1), mesh.F(t, 2));
    }
    std::vector<int> label(at(mesh.vertex_count()), -1);
    topology.component.resize(at(mesh.face_count()));
    for (int t = 0; t < mesh.face_count(); ++t) {
        int& name = label[at(sets.find(mesh.F(t, 0)))];
        if (name < 0) name = topology.component_count++;
        topology.component[at(t)] = name;
    }
}

template <class Items, class Condition>
int count_where(const Items& items, Condition condition) {
    return static_cast<int>(std::count_if(items.begin(), items.end(), condition));
}

}   // namespace

Incidence triangles_around(const TriangleMesh& mesh) {
    Incidence around;
    around.start.assign(at(mesh.vertex_count()) + 1, 0);
    for (const int v : mesh.F.reshaped()) ++around.start[at(v) + 1];
    std::partial_sum(around.start.begin(), around.start.end(), around.start.begin());
    around.item.resize(at(mesh.face_count()) * 3);
    std::vector<int> next(around.start.begin(), around.start.end() - 1);
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) around.item[at(next[at(mesh.F(t, k))]++)] = t;
    }
    return around;
}

std::vector<Edge> edges_of(const TriangleMesh& mesh) { return collected_edges(mesh, triangles_around(mesh)); }

MeshTopology topology_of(const TriangleMesh& mesh) {
    check_faces(mesh);
    MeshTopology topology;
    topology.vertex_faces = triangles_around(mesh);
    topology.edges = collected_edges(mesh, topology.vertex_faces);
    topology.neighbours = one_rings(mesh.vertex_count(), topology.edges);
    flag_vertices(mesh, topology);
    label_components(mesh, topology);
    return topology;
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
