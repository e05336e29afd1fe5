#include "mesh/mesh_topology.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace meshfolio {

namespace {

/// The side of triangle `face` from `a` to `b` with a < b.
struct HalfEdge {
    int a, b, face;
    friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

std::vector<HalfEdge> sorted_half_edges(const Faces& F) {
    std::vector<HalfEdge> sides;
    sides.reserve(static_cast<std::size_t>(F.size()));
    for (int t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(F(t, k), F(t, (k + 1) % 3));
            sides.push_back({a, b, t});
        }
    }
    std::sort(sides.begin(), sides.end());
    return sides;
}

/// Rows from (row, item) pairs given in the order the items shall have, by counting.
template <class RowOf, class ItemOf>
Incidence incidence_of(int rows, std::size_t pairs, RowOf row_of, ItemOf item_of) {
    Incidence lists;
    lists.start.assign(static_cast<std::size_t>(rows) + 1, 0);
    for (std::size_t i = 0; i < pairs; ++i) ++lists.start[static_cast<std::size_t>(row_of(i)) + 1];
    std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
    lists.item.resize(pairs);
    std::vector<int> next(lists.start.begin(), lists.start.end() - 1);
    for (std::size_t i = 0; i < pairs; ++i) lists.item[static_cast<std::size_t>(next[static_cast<std::size_t>(row_of(i))]++)] = item_of(i);
    return lists;
}

/// Disjoint sets with the smallest member as representative.
class Sets {
public:
    explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int i) {
        while (parent_[static_cast<std::size_t>(i)] != i) {
            int& parent = parent_[static_cast<std::size_t>(i)];
            parent = parent_[static_cast<std::size_t>(parent)];
            i = parent;
        }
        return i;
    }
    void join(int i, int j) {
        i = find(i);
        j = find(j);
        parent_[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
    }

private:
    std::vector<int> parent_;
};

/// A vertex is regular when its triangles, joined across the edges at the vertex, form one fan. Joins the corners (t, k) of each vertex
/// over the shared sides and counts the fans.
void mark_pinched_vertices(const Faces& F, const std::vector<HalfEdge>& sides, std::vector<char>& nonmanifold) {
    Sets corners(static_cast<std::size_t>(F.size()));
    const auto corner_of = [&](int face, int vertex) {
        for (int k = 0; k < 3; ++k) {
            if (F(face, k) == vertex) return 3 * face + k;
        }
        return 3 * face;   // not reached: sides name vertices of their face
    };
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].a != sides[i - 1].a || sides[i].b != sides[i - 1].b) continue;
        for (const int v : {sides[i].a, sides[i].b}) corners.join(corner_of(sides[i - 1].face, v), corner_of(sides[i].face, v));
    }
    std::vector<int> fan(nonmanifold.size(), -1);
    for (int t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(F(t, k));
            const int root = corners.find(3 * t + k);
            if (fan[v] >= 0 && fan[v] != root) nonmanifold[v] = 1;
            fan[v] = root;
        }
    }
}

void label_components(const Faces& F, int vertex_count, MeshTopology& topology) {
    Sets vertices(static_cast<std::size_t>(vertex_count));
    for (int t = 0; t < F.rows(); ++t) {
        vertices.join(F(t, 0), F(t, 1));
        vertices.join(F(t, 0), F(t, 2));
    }
    std::vector<int> label(static_cast<std::size_t>(vertex_count), -1);
    topology.component.resize(static_cast<std::size_t>(F.rows()));
    for (int t = 0; t < F.rows(); ++t) {
        int& name = label[static_cast<std::size_t>(vertices.find(F(t, 0)))];
        if (name < 0) name = topology.component_count++;
        topology.component[static_cast<std::size_t>(t)] = name;
    }
}

}   // namespace

int MeshTopology::boundary_edge_count() const {
    return static_cast<int>(std::count_if(edges.begin(), edges.end(), [](const Edge& e) { return e.faces == 1; }));
}

int MeshTopology::nonmanifold_edge_count() const {
    return static_cast<int>(std::count_if(edges.begin(), edges.end(), [](const Edge& e) { return e.faces > 2; }));
}

int MeshTopology::nonmanifold_vertex_count() const { return static_cast<int>(std::count(nonmanifold.begin(), nonmanifold.end(), 1)); }

MeshTopology topology_of(const TriangleMesh& mesh) {
    const int n = mesh.vertex_count();
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh.F);
    MeshTopology topology;
    for (const HalfEdge& side : sides) {
        if (topology.edges.empty() || topology.edges.back().a != side.a || topology.edges.back().b != side.b)
            topology.edges.push_back({side.a, side.b, 0});
        ++topology.edges.back().faces;
    }
    const auto corners = static_cast<std::size_t>(mesh.F.size());
    topology.vertex_faces = incidence_of(
        n, corners, [&](std::size_t i) { return mesh.F.data()[i]; }, [](std::size_t i) { return static_cast<int>(i / 3); });
    // Edges are sorted by (a, b): first every b gets its smaller neighbours, then every a its larger ones, so rows ascend.
    const std::size_t edges = topology.edges.size();
    topology.neighbours = incidence_of(
        n, 2 * edges, [&](std::size_t i) { return i < edges ? topology.edges[i].b : topology.edges[i - edges].a; },
        [&](std::size_t i) { return i < edges ? topology.edges[i].a : topology.edges[i - edges].b; });

    topology.on_boundary.assign(static_cast<std::size_t>(n), 0);
    topology.nonmanifold.assign(static_cast<std::size_t>(n), 0);
    for (const Edge& edge : topology.edges) {
        for (const int v : {edge.a, edge.b}) {
            if (edge.faces == 1) topology.on_boundary[static_cast<std::size_t>(v)] = 1;
            if (edge.faces > 2) topology.nonmanifold[static_cast<std::size_t>(v)] = 1;
        }
    }
    mark_pinched_vertices(mesh.F, sides, topology.nonmanifold);
    label_components(mesh.F, n, topology);
    return topology;
}

std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    std::vector<std::array<int, 2>> directed;   // boundary sides in the sense of their triangle
    const auto is_boundary = [&](int a, int b) {
        const auto [low, high] = std::minmax(a, b);
        const auto it = std::lower_bound(topology.edges.begin(), topology.edges.end(), std::pair(low, high),
                                         [](const Edge& e, const std::pair<int, int>& key) { return std::pair(e.a, e.b) < key; });
        return it->faces == 1;
    };
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.F(t, k), b = mesh.F(t, (k + 1) % 3);
            if (is_boundary(a, b)) directed.push_back({a, b});
        }
    }
    std::sort(directed.begin(), directed.end());
    std::vector<char> used(directed.size(), 0);
    std::vector<std::vector<int>> loops;
    for (std::size_t first = 0; first < directed.size(); ++first) {
        if (used[first]) continue;
        std::vector<int> loop;
        for (std::size_t at = first; !used[at];) {
            used[at] = 1;
            loop.push_back(directed[at][0]);
            const int next = directed[at][1];
            // At a pinched vertex several sides leave; the first unused one is taken.
            auto it = std::lower_bound(directed.begin(), directed.end(), std::array{next, -1});
            while (it != directed.end() && (*it)[0] == next && used[static_cast<std::size_t>(it - directed.begin())]) ++it;
            if (it == directed.end() || (*it)[0] != next) break;
            at = static_cast<std::size_t>(it - directed.begin());
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

}   // namespace meshfolio
