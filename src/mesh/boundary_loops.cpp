#include <algorithm>
#include <numeric>

#include "base/at.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

struct BoundaryEdge {
    int from, to;   // as its triangle runs through it
};

/// The boundary edges, sorted by their ends, each running as in its one triangle.
std::vector<BoundaryEdge> boundary_edges(const TriangleMesh& mesh, const std::vector<Edge>& edges) {
    std::vector<char> on_boundary(at(mesh.vertex_count()), 0);
    for (const Edge& e : edges)
        if (e.faces == 1) on_boundary[at(e.a)] = on_boundary[at(e.b)] = 1;
    const auto faces_at = [&](int a, int b) {
        const auto before = [](const Edge& e, const Edge& f) { return e.a != f.a ? e.a < f.a : e.b < f.b; };
        return std::lower_bound(edges.begin(), edges.end(), Edge{std::min(a, b), std::max(a, b), 0}, before)->faces;
    };
    std::vector<BoundaryEdge> boundary;
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.F(t, k);
            const int b = mesh.F(t, (k + 1) % 3);
            if (on_boundary[at(a)] != 0 && on_boundary[at(b)] != 0 && a != b && faces_at(a, b) == 1) boundary.push_back({a, b});
        }
    }
    std::sort(boundary.begin(), boundary.end(), [](auto& e, auto& f) { return e.from != f.from ? e.from < f.from : e.to < f.to; });
    return boundary;
}

/// The edges at each vertex, and how many of them were looked at: a row may be as long as the boundary, and is gone through once.
class Rows {
public:
    template <class End>
    Rows(int vertices, const std::vector<BoundaryEdge>& edges, End end) : start_(at(vertices) + 1, 0), item_(edges.size()) {
        for (const BoundaryEdge& e : edges) ++start_[at(end(e)) + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        next_.assign(start_.begin(), start_.end() - 1);
        std::vector<int> free = next_;
        for (std::size_t e = 0; e < edges.size(); ++e) item_[at(free[at(end(edges[e]))]++)] = static_cast<int>(e);
    }

    /// The next edge at v, or −1.
    int take(int v) { return next_[at(v)] < start_[at(v) + 1] ? item_[at(next_[at(v)]++)] : -1; }

private:
    std::vector<int> start_, item_, next_;
};

/// A walk over the boundary that uses each edge once, forwards where it can: where triangles disagree about the orientation, or
/// non-manifold edges end the boundary, an edge may have to be walked backwards, or the walk to stop.
class BoundaryWalk {
public:
    BoundaryWalk(int vertices, const std::vector<BoundaryEdge>& edges)
        : edges_(edges),
          used_(edges.size(), 0),
          out_(vertices, edges, [](const BoundaryEdge& e) { return e.from; }),
          in_(vertices, edges, [](const BoundaryEdge& e) { return e.to; }) {}

    /// Takes the next edge at v and gives its other end, or −1.
    int step(int v) {
        if (const int e = unused(out_, v); e >= 0) return edges_[at(e)].to;
        if (const int e = unused(in_, v); e >= 0) return edges_[at(e)].from;
        return -1;
    }

private:
    int unused(Rows& rows, int v) {
        int e = rows.take(v);
        while (e >= 0 && used_[at(e)] != 0) e = rows.take(v);
        if (e >= 0) used_[at(e)] = 1;
        return e;
    }

    const std::vector<BoundaryEdge>& edges_;
    std::vector<char> used_;
    Rows out_, in_;
};

std::vector<int> from_smallest(std::vector<int> loop) {
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    return loop;
}

}   // namespace

std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh) { return boundary_loops(mesh, edges_of(mesh)); }

std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh, const std::vector<Edge>& all_edges) {
    const std::vector<BoundaryEdge> edges = boundary_edges(mesh, all_edges);
    BoundaryWalk walk(mesh.vertex_count(), edges);
    std::vector<std::vector<int>> loops;
    std::vector<int> path;
    std::vector<int> place(at(mesh.vertex_count()), -1);   // of each vertex on the path
    const auto cut_off = [&](int first) {
        loops.push_back(from_smallest({path.begin() + first, path.end()}));
        for (auto v = path.begin() + first; v != path.end(); ++v) place[at(*v)] = -1;
        path.erase(path.begin() + first, path.end());
    };
    for (const BoundaryEdge& start : edges) {
        for (int v = start.from; v >= 0; v = walk.step(v)) {
            // A vertex seen before closes a loop, which leaves the path; the walk goes on from there.
            if (place[at(v)] >= 0) cut_off(place[at(v)]);
            place[at(v)] = static_cast<int>(path.size());
            path.push_back(v);
        }
        if (path.size() > 1) cut_off(0);   // an open piece
        for (const int v : path) place[at(v)] = -1;
        path.clear();
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

}   // namespace meshfolio
