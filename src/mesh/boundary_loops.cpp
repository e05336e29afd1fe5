#include <algorithm>
#include <utility>

#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

struct BoundaryEdge {
    int from, to;   // as its triangle runs through it
};

/// Returns the edges with one triangle, directed as it runs through them, sorted by their ends.
std::vector<BoundaryEdge> boundary_edges(const TriangleMesh& mesh, const std::vector<Edge>& edges) {
    std::vector<char> on_boundary(at(mesh.vertex_count()), 0);
    for (const Edge& e : edges)
        if (e.faces == 1) on_boundary[at(e.a)] = on_boundary[at(e.b)] = 1;
    const auto faces_at = [&](int a, int b) {
        const auto ends = [](const Edge& e) { return std::pair(e.a, e.b); };
        return std::ranges::lower_bound(edges, std::pair(std::min(a, b), std::max(a, b)), {}, ends)->faces;
    };
    std::vector<BoundaryEdge> boundary;
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.F(t, k), b = mesh.F(t, (k + 1) % 3);
            if (on_boundary[at(a)] != 0 && on_boundary[at(b)] != 0 && a != b && faces_at(a, b) == 1) boundary.push_back({a, b});
        }
    }
    std::ranges::sort(boundary, {}, [](const BoundaryEdge& e) { return std::pair(e.from, e.to); });
    return boundary;
}

/// A walk over the boundary that uses each edge once, forwards if possible: at edges on which triangles disagree about the orientation, or
/// at non-manifold ones, it may have to go backwards or to stop.
class BoundaryWalk {
public:
    BoundaryWalk(int vertices, const std::vector<BoundaryEdge>& edges) : edges_(edges), used_(edges.size(), 0) {
        std::vector<int> from, to;
        for (const BoundaryEdge& e : edges) {
            from.push_back(e.from);
            to.push_back(e.to);
        }
        leaving_ = grouped_by_row(vertices, from);
        arriving_ = grouped_by_row(vertices, to);
        next_leaving_ = leaving_.start;
        next_arriving_ = arriving_.start;
    }

    /// Uses the next edge at v. Returns its other end, or −1 if no edge is left.
    int step(int v) {
        if (const int e = take(leaving_, next_leaving_, v); e >= 0) return edges_[at(e)].to;
        if (const int e = take(arriving_, next_arriving_, v); e >= 0) return edges_[at(e)].from;
        return -1;
    }

private:
    /// Marks the first unused edge in row v of `rows` as used and returns it; −1 if none is left. A row may be as long as the boundary, so
    /// it is searched once, from `next` on.
    int take(const Incidence& rows, std::vector<int>& next, int v) {
        while (next[at(v)] < rows.start[at(v) + 1])
            if (const int e = rows.item[at(next[at(v)]++)]; std::exchange(used_[at(e)], 1) == 0) return e;
        return -1;
    }

    const std::vector<BoundaryEdge>& edges_;
    std::vector<char> used_;
    Incidence leaving_, arriving_;
    std::vector<int> next_leaving_, next_arriving_;   // of each vertex
};

}   // namespace

std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh) { return boundary_loops(mesh, edges_of(mesh)); }

std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh, const std::vector<Edge>& all_edges) {
    const std::vector<BoundaryEdge> edges = boundary_edges(mesh, all_edges);
    BoundaryWalk walk(mesh.vertex_count(), edges);
    std::vector<std::vector<int>> loops;
    std::vector<int> path;
    std::vector<int> place(at(mesh.vertex_count()), -1);   // of each vertex on the path
    const auto cut_off = [&](int first) {
        std::vector<int>& loop = loops.emplace_back(path.begin() + first, path.end());
        for (const int v : loop) place[at(v)] = -1;
        std::ranges::rotate(loop, std::ranges::min_element(loop));
        path.resize(at(first));
    };
    for (const BoundaryEdge& start : edges) {
        for (int v = start.from; v >= 0; v = walk.step(v)) {
            // A vertex that is on the path already closes a loop, which leaves the path; the walk goes on from there.
            if (place[at(v)] >= 0) cut_off(place[at(v)]);
            place[at(v)] = static_cast<int>(path.size());
            path.push_back(v);
        }
        if (path.size() > 1) cut_off(0);   // an open piece
        for (const int v : path) place[at(v)] = -1;
        path.clear();
    }
    std::ranges::sort(loops);
    return loops;
}

}   // namespace meshfolio
