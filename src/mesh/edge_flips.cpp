#include "mesh/edge_flips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/errors.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

/// Corner k of a triangle; also the edge opposite it.
struct Corner {
    int triangle = -1, k = 0;
    bool exists() const { return triangle >= 0; }
};

class Flipper {
public:
    explicit Flipper(const TriangleMesh& mesh)
        : X_(mesh.X), F_(mesh.F), across_(at(mesh.face_count()) * 3), neighbours_(at(mesh.vertex_count())) {
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
                    if (!open.try_emplace({a, b}, here).second)
                        throw MeshError("edge flips: more than two triangles share the edge of vertices " + std::to_string(a) + " and " +
                                            std::to_string(b),
                                        "flip the edges of a manifold mesh");
                }
            }
        }
    }

    /// Tries each edge of the mesh once. Returns the number of edges flipped.
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
    Corner& across(const Corner& c) { return across_[3 * at(c.triangle) + at(c.k)]; }

    void join(const Corner& a, const Corner& b) {
        if (a.exists()) across(a) = b;
        if (b.exists()) across(b) = a;
    }

    void add_edge(int a, int b) {
        neighbours_[at(a)].push_back(b);
        neighbours_[at(b)].push_back(a);
    }

    double cotangent_at(int apex, int b, int c) const {
        const Vector3 u = point(b) - point(apex), v = point(c) - point(apex);
        return u.dot(v) / u.cross(v).norm();
    }

    Vector3 unit_normal(int a, int b, int c) const { return (point(b) - point(a)).cross(point(c) - point(a)).normalized(); }

    /// Replaces edge b–c between the triangles (a, b, c) and (d, c, b) by a–d, if that makes them Delaunay and no crease is near.
    bool flipped_if_better(const Corner& here) {
        const Corner there = across(here);
        if (!there.exists()) return false;
        const int a = vertex(here), b = vertex(here, 1), c = vertex(here, 2), d = vertex(there);
        constexpr double clear = 1e-6;
        if (!(cotangent_at(a, b, c) + cotangent_at(d, c, b) < -clear)) return false;
        if (std::ranges::count(neighbours_[at(a)], d) > 0 || creases(a, b, c, d)) return false;
        std::erase(neighbours_[at(b)], c);
        std::erase(neighbours_[at(c)], b);
        add_edge(a, d);
        // The new triangles are (a, b, d) and (d, c, a): `here` keeps a and b, `there` keeps d and c.
        const Corner opposite_b{here.triangle, (here.k + 1) % 3}, opposite_c{there.triangle, (there.k + 1) % 3};
        const Corner beyond_ca = across(opposite_b), beyond_bd = across(opposite_c);
        F_(here.triangle, (here.k + 2) % 3) = d;
        F_(there.triangle, (there.k + 2) % 3) = a;
        across(here) = {};
        across(there) = {};
        join(here, beyond_bd);
        join(there, beyond_ca);
        join(opposite_b, opposite_c);
        return true;
    }

    /// True if the surface has a crease along b–c, or would get one along a–d, or a fold.
    bool creases(int a, int b, int c, int d) const {
        constexpr double cos_limit = 0.5;
        const Vector3 one = unit_normal(a, b, c), other = unit_normal(d, c, b);
        const Vector3 new_one = unit_normal(a, b, d), new_other = unit_normal(d, c, a), mean = (one + other).normalized();
        return !(one.dot(other) > cos_limit && new_one.dot(new_other) > cos_limit && new_one.dot(mean) > cos_limit &&
                 new_other.dot(mean) > cos_limit);
    }

    const Positions& X_;
    Faces F_;
    std::vector<Corner> across_;                 // of corner k of triangle t at 3 t + k
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
        if (weight[v] > 0 && !on_boundary[at(v)]) steps.row(v) = moment.row(v) / weight[v] - mesh.X.row(v);
    return steps;
}

}   // namespace meshfolio
