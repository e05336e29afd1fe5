#include <algorithm>
#include <numeric>

#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

struct BoundaryEdge {
    int from, to;   // as its triangle runs through it
};

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The boundary edges, sorted by their ends, each running as in its one triangle.
std::vector<BoundaryEdge> boundary_edges(const TriangleMesh& mesh, const std::vector<Edge>& edges) {
    std::vector<char> on_boundary(at(mesh.vertex_count()), 0);
    for (const Edge& e : edges) {
        if (e.faces == 1) on_boundary[at(e.a)] = on_boundary[at(e.b)] = 1;
    }
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

/// A walk over the boundary that uses each edge once, forwards where it can: where triangles disagree about the orientation, or
/// non-manifold edges end the boundary, an edge may have to be walked backwards, or the walk to stop.
class BoundaryWalk {
public:
    BoundaryWalk(int vertices, const std::vector<BoundaryEdge>& edges) : edges_(edges), used_(edges.size(), 0) {
        out_ = rows(vertices, [](const BoundaryEdge& e) { return e.from; });
        in_ = rows(vertices, [](const BoundaryEdge& e) { return e.to; });
    }

    /// Takes the next edge at v and gives its other end, or −1.
    int step(int v) {
        for (const int* e = out_.begin(v); e != out_.end(v); ++e) {
            if (take(*e)) return edges_[at(*e)].to;
        }
        for (const int* e = in_.begin(v); e != in_.end(v); ++e) {
            if (take(*e)) return edges_[at(*e)].from;
        }
        return -1;
    }

private:
    template <class End>
    Incidence rows(int vertices, End end) const {
        Incidence incidence;
        incidence.start.assign(at(vertices) + 1, 0);
        for (const BoundaryEdge& e : edges_) ++incidence.start[at(end(e)) + 1];
        std::partial_sum(incidence.start.begin(), incidence.start.end(), incidence.start.begin());
        incidence.item.resize(edges_.size());
        std::vector<int> next(incidence.start.begin(), incidence.start.end() - 1);
        for (std::size_t e = 0; e < edges_.size(); ++e) incidence.item[at(next[at(end(edges_[e]))]++)] = static_cast<int>(e);
        return incidence;
    }

    bool take(int e) {
        const bool taken = used_[at(e)] == 0;
        used_[at(e)] = 1;
        return taken;
    }

    const std::vector<BoundaryEdge>& edges_;
    std::vector<char> used_;
    Incidence out_, in_;
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
