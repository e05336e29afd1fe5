#include "mesh/mesh_topology.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/large_pages.h"
#include "base/parallel.h"
#include "mesh/disjoint_sets.h"
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

/// Whether every edge at v has two triangles.
bool is_inside(const MeshTopology& topology, int v) { return topology.on_boundary[at(v)] == 0 && topology.nonmanifold[at(v)] == 0; }

/// Fills what can be told of each vertex alone, and the lengths of the one-rings.
/// @return  the smallest vertex among each and its neighbours
std::vector<int> look_at_fans(const TriangleMesh& mesh, MeshTopology& topology) {
    const int vertices = mesh.vertex_count();
    topology.on_boundary.resize(at(vertices));
    topology.nonmanifold.resize(at(vertices));
    topology.neighbours.start.assign(at(vertices) + 1, 0);
    std::vector<int> smallest(at(vertices));
    const auto regular = of_blocks(vertices, [&](int begin, int end) {
        FanReader fans(mesh, topology.vertex_faces);
        bool all = true;
        for (int v = begin; v < end; ++v) {
            const FanFacts facts = fans.facts(v);
            topology.on_boundary[at(v)] = facts.on_boundary ? 1 : 0;
            topology.nonmanifold[at(v)] = facts.nonmanifold ? 1 : 0;
            topology.neighbours.start[at(v) + 1] = facts.ring_size;
            smallest[at(v)] = facts.smallest_neighbour;
            all &= facts.regular;
        }
        return all;
    });
    topology.oriented_manifold = std::all_of(regular.begin(), regular.end(), [](const auto& block) { return block.value; });
    std::vector<int>& start = topology.neighbours.start;
    std::partial_sum(start.begin(), start.end(), start.begin());
    return smallest;
}

/// The sets of vertices that triangles join. Each vertex hangs on its smallest neighbour, which leaves far fewer sets; then those
/// triangles join the rest whose corners are still in different ones.
DisjointSets joined_vertices(const TriangleMesh& mesh, std::vector<int> smallest_neighbour) {
    DisjointSets sets(std::move(smallest_neighbour));
    for_each_index(mesh.face_count(), [&](int t) {
        sets.join_concurrently(mesh.F(t, 0), mesh.F(t, 1));
        sets.join_concurrently(mesh.F(t, 1), mesh.F(t, 2));
    });
    sets.flatten();
    return sets;
}

/// Names the sets in the order of their first triangles: of each block only the places where the set changes are looked at.
void label_components(const TriangleMesh& mesh, const DisjointSets& sets, MeshTopology& topology) {
    const auto set_of = [&](int t) { return sets.found(mesh.F(t, 0)); };
    const auto changes = of_blocks(mesh.face_count(), [&](int begin, int end) {
        std::vector<int> runs;
        for (int t = begin; t < end; ++t) {
            if (runs.empty() || runs.back() != set_of(t)) runs.push_back(set_of(t));
        }
        return runs;
    });
    std::vector<int> label(at(mesh.vertex_count()), -1);
    for (const auto& block : changes) {
        for (const int set : block.value) {
            if (label[at(set)] < 0) label[at(set)] = topology.component_count++;
        }
    }
    topology.component = large_vector<int>(at(mesh.face_count()));
    for_each_index(mesh.face_count(), [&](int t) { topology.component[at(t)] = label[at(set_of(t))]; });
}

/// Fills the one-rings. @return  how many edges lead to a larger vertex, block by block
std::vector<std::size_t> list_neighbours(const TriangleMesh& mesh, MeshTopology& topology) {
    Incidence& ring = topology.neighbours;
    ring.item = large_vector<int>(at(ring.start.back()));
    const auto upwards = of_blocks(mesh.vertex_count(), [&](int begin, int end) {
        FanReader fans(mesh, topology.vertex_faces);
        std::size_t edges = 0;
        for (int v = begin; v < end; ++v) {
            const auto row = fans.ring(v, topology.oriented_manifold && is_inside(topology, v));
            std::copy(row.begin(), row.end(), ring.item.begin() + ring.start[at(v)]);
            edges += at(static_cast<int>(std::count_if(row.begin(), row.end(), [v](int w) { return w > v; })));
        }
        return edges;
    });
    std::vector<std::size_t> counts;
    for (const auto& block : upwards) counts.push_back(block.value);
    return counts;
}

/// The other vertices of every triangle at a, sorted; one that a triangle names twice counts once.
void collect_ends(const TriangleMesh& mesh, const Incidence& vertex_faces, int a, std::vector<int>& ends) {
    ends.clear();
    for (const int* t = vertex_faces.begin(a); t != vertex_faces.end(a); ++t) {
        const int b = mesh.F(*t, 0), c = mesh.F(*t, 1), d = mesh.F(*t, 2);
        if (b != a) ends.push_back(b);
        if (c != a && c != b) ends.push_back(c);
        if (d != a && d != b && d != c) ends.push_back(d);
    }
    std::sort(ends.begin(), ends.end());
}

/// Fills the edges: in the order of their smaller ends, which is that of the rows.
void list_edges(const TriangleMesh& mesh, MeshTopology& topology, const std::vector<std::size_t>& edges_of_blocks) {
    std::vector<std::size_t> first(edges_of_blocks.size());
    std::exclusive_scan(edges_of_blocks.begin(), edges_of_blocks.end(), first.begin(), std::size_t{0});
    topology.edges = large_vector<Edge>(edges_of_blocks.empty() ? 0 : first.back() + edges_of_blocks.back());
    for_blocks(mesh.vertex_count(), [&](int block, int begin, int end) {
        auto edge = topology.edges.begin() + static_cast<std::ptrdiff_t>(first[at(block)]);
        std::vector<int> ends;   // of the edges at a that is not inside, once for each of their triangles
        for (int a = begin; a < end; ++a) {
            if (!is_inside(topology, a)) collect_ends(mesh, topology.vertex_faces, a, ends);
            const auto faces = [&](int b) {
                const auto [from, to] = std::equal_range(ends.begin(), ends.end(), b);
                return to - from;
            };
            const int* const last = topology.neighbours.end(a);
            for (const int* b = std::upper_bound(topology.neighbours.begin(a), last, a); b != last; ++b) {
                *edge++ = {a, *b, is_inside(topology, a) ? 2 : static_cast<int>(faces(*b))};
            }
        }
    });
}

template <class Items, class Condition>
int count_where(const Items& items, Condition condition) {
    return static_cast<int>(std::count_if(items.begin(), items.end(), condition));
}

}   // namespace

std::vector<Edge> edges_of(const TriangleMesh& mesh) { return collected_edges(mesh, triangles_around(mesh)); }

MeshTopology topology_without_edges(const TriangleMesh& mesh) {
    MeshTopology topology;
    topology.vertex_faces = triangles_around(mesh);
    label_components(mesh, joined_vertices(mesh, look_at_fans(mesh, topology)), topology);
    return topology;
}

MeshTopology with_edges(MeshTopology topology, const TriangleMesh& mesh) {
    list_edges(mesh, topology, list_neighbours(mesh, topology));
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
