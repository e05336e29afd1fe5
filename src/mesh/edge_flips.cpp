#include "mesh/edge_flips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

/// A triangle and one of its corners; also the edge opposite that corner.
struct Corner {
    int triangle = -1, k = 0;
    bool exists() const { return triangle >= 0; }
};

class Flipper {
public:
    explicit Flipper(const TriangleMesh& mesh) : X_(mesh.X), F_(mesh.F) {
        across_.resize(static_cast<std::size_t>(3 * F_.rows()));
        neighbours_.resize(static_cast<std::size_t>(X_.rows()));
        connect();
    }

    /// Number of edges flipped.
    int pass() {
        int flipped = 0;
        for (int t = 0; t < F_.rows(); ++t)
            for (int k = 0; k < 3; ++k) flipped += flipped_if_better({t, k});
        return flipped;
    }

    const Faces& faces() const { return F_; }

private:
    int vertex(const Corner& c, int offset = 0) const { return F_(c.triangle, (c.k + offset) % 3); }
    Vector3 point(int v) const { return X_.row(v); }
    Corner& across(const Corner& c) { return across_[3 * static_cast<std::size_t>(c.triangle) + static_cast<std::size_t>(c.k)]; }

    void connect() {
        std::map<std::pair<int, int>, Corner> open;
        for (int t = 0; t < F_.rows(); ++t) {
            for (int k = 0; k < 3; ++k) {
                const Corner here{t, k};
                const int a = vertex(here, 1), b = vertex(here, 2);
                if (const auto other = open.find({b, a}); other != open.end()) {
                    join(here, other->second);
                    open.erase(other);
                } else {
                    add_edge(a, b);
                    if (!open.try_emplace({a, b}, here).second) throw MeshError("delaunay_flipped: more than two triangles share an edge");
                }
            }
        }
    }

    void join(const Corner& a, const Corner& b) {
        if (a.exists()) across(a) = b;
        if (b.exists()) across(b) = a;
    }

    void add_edge(int a, int b) {
        neighbours_[static_cast<std::size_t>(a)].push_back(b);
        neighbours_[static_cast<std::size_t>(b)].push_back(a);
    }

    void remove_edge(int a, int b) {
        std::erase(neighbours_[static_cast<std::size_t>(a)], b);
        std::erase(neighbours_[static_cast<std::size_t>(b)], a);
    }

    bool are_neighbours(int a, int b) const { return std::ranges::count(neighbours_[static_cast<std::size_t>(a)], b) > 0; }

    double cotangent_at(int apex, int b, int c) const {
        const Vector3 u = point(b) - point(apex), v = point(c) - point(apex);
        return u.dot(v) / u.cross(v).norm();
    }

    Vector3 unit_normal(int a, int b, int c) const { return (point(b) - point(a)).cross(point(c) - point(a)).normalized(); }

    /// The edge b–c between triangles (a, b, c) and (d, c, b) becomes a–d.
    bool flipped_if_better(const Corner& here) {
        const Corner there = across(here);
        if (!there.exists()) return false;
        const int a = vertex(here), b = vertex(here, 1), c = vertex(here, 2), d = vertex(there);
        constexpr double clear = 1e-6;
        if (!(cotangent_at(a, b, c) + cotangent_at(d, c, b) < -clear)) return false;
        if (are_neighbours(a, d) || creases(a, b, c, d)) return false;
        remove_edge(b, c);
        add_edge(a, d);
        rewire(here, there);
        return true;
    }

    /// Whether the surface has a crease along b–c, or would get one along a–d, or a fold.
    bool creases(int a, int b, int c, int d) const {
        constexpr double cos_limit = 0.5;
        const Vector3 one = unit_normal(a, b, c), other = unit_normal(d, c, b);
        const Vector3 new_one = unit_normal(a, b, d), new_other = unit_normal(d, c, a), mean = (one + other).normalized();
        return !(one.dot(other) > cos_limit && new_one.dot(new_other) > cos_limit && new_one.dot(mean) > cos_limit &&
                 new_other.dot(mean) > cos_limit);
    }

    /// (a, b, c), (d, c, b) → (a, b, d), (d, c, a): `here` keeps a and b, `there` keeps d and c.
    void rewire(const Corner& here, const Corner& there) {
        const Corner beyond_ca = across({here.triangle, (here.k + 1) % 3}), beyond_bd = across({there.triangle, (there.k + 1) % 3});
        const int a = vertex(here), d = vertex(there);
        F_(here.triangle, (here.k + 2) % 3) = d;
        F_(there.triangle, (there.k + 2) % 3) = a;
        const Corner opposite_b{here.triangle, (here.k + 1) % 3}, opposite_c{there.triangle, (there.k + 1) % 3};
        across(here) = {};
        across(there) = {};
        join(here, beyond_bd);
        join(there, beyond_ca);
        join(opposite_b, opposite_c);
    }

    const Positions& X_;
    Faces F_;
    std::vector<Corner> across_;                 // of triangle t, corner k at 3 t + k
    std::vector<std::vector<int>> neighbours_;   // of each vertex
};

}   // namespace

Faces delaunay_flipped(const TriangleMesh& mesh, int passes) {
    Flipper flipper(mesh);
    for (int i = 0; i < passes; ++i)
        if (flipper.pass() == 0) break;
    return flipper.faces();
}

Positions steps_to_ring_centroids(const TriangleMesh& mesh) {
    Positions moment = Positions::Zero(mesh.X.rows(), 3);
    Vector weight = Vector::Zero(mesh.X.rows());
    for (const auto& f : mesh.F.rowwise()) {
        const Vector3 a = mesh.X.row(f[0]), b = mesh.X.row(f[1]), c = mesh.X.row(f[2]);
        const double area = 0.5 * (b - a).cross(c - a).norm();
        for (int k = 0; k < 3; ++k) {
            moment.row(f[k]) += area / 3 * (a + b + c).transpose();
            weight[f[k]] += area;
        }
    }
    const std::vector<char> on_boundary = topology_of(mesh).on_boundary;
    Positions steps = Positions::Zero(mesh.X.rows(), 3);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (weight[v] > 0 && !on_boundary[static_cast<std::size_t>(v)]) steps.row(v) = moment.row(v) / weight[v] - mesh.X.row(v);
    return steps;
}

}   // namespace meshfolio
