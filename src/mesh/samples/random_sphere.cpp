#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/errors.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {

namespace {

/// The hull of points on a sphere, by insertion: a new point splits the triangle below it, then edges at which the surface is not convex
/// are flipped (Lawson 1977). On a sphere this is the Delaunay triangulation.
class GrowingHull {
public:
    explicit GrowingHull(const Positions& X) : X_(X) {
        vertices_.reserve(static_cast<std::size_t>(2 * X.rows()));
        across_.reserve(static_cast<std::size_t>(2 * X.rows()));
        // Points 0 … 5 are +x, −x, +y, −y, +z, −z; triangle t has a vertex of each axis, positive where its bit is 0.
        for (int t = 0; t < 8; ++t) {
            const int x = t & 1, y = t >> 1 & 1, z = t >> 2 & 1;
            const bool turned = (x ^ y ^ z) != 0;
            const int beyond_x = t ^ 1, beyond_y = t ^ 2, beyond_z = t ^ 4;   // across the edge opposite the corner on that axis
            vertices_.push_back(turned ? std::array{x, 4 + z, 2 + y} : std::array{x, 2 + y, 4 + z});
            across_.push_back(turned ? std::array{beyond_x, beyond_z, beyond_y} : std::array{beyond_x, beyond_y, beyond_z});
        }
    }

    void insert(int p) {
        const int t = triangle_below(p), second = static_cast<int>(vertices_.size()), third = second + 1;
        const auto [a, b, c] = at(t);
        const auto [beyond_a, beyond_b, beyond_c] = across_[index(t)];
        vertices_.push_back({p, c, a});
        across_.push_back({beyond_b, third, t});
        vertices_.push_back({p, a, b});
        across_.push_back({beyond_c, t, second});
        at(t) = {p, b, c};
        across_[index(t)] = {beyond_a, second, third};
        rename_neighbour(beyond_b, t, second);
        rename_neighbour(beyond_c, t, third);
        for (const int changed : {t, second, third}) pending_.push_back(changed);
        while (!pending_.empty()) {
            const int next = pending_.back();
            pending_.pop_back();
            flip_where_not_convex(next);
        }
        last_ = t;
    }

    Faces faces() const {
        Faces F(static_cast<Eigen::Index>(vertices_.size()), 3);
        for (Eigen::Index t = 0; t < F.rows(); ++t) F.row(t) << vertices_[index(t)][0], vertices_[index(t)][1], vertices_[index(t)][2];
        return F;
    }

private:
    static std::size_t index(Eigen::Index t) { return static_cast<std::size_t>(t); }
    std::array<int, 3>& at(int t) { return vertices_[index(t)]; }
    Vector3 point(int v) const { return X_.row(v).transpose(); }

    /// Finds the triangle below p: walks from the triangle last changed across edges beyond which p lies.
    int triangle_below(int p) {
        int t = last_;
        for (std::size_t k = 0; k < 3;) {
            const Vector3 a = point(at(t)[(k + 1) % 3]), b = point(at(t)[(k + 2) % 3]);
            const bool is_beyond = a.cross(b).dot(point(p)) < 0;
            if (is_beyond) t = across_[index(t)][k];
            k = is_beyond ? 0 : k + 1;
        }
        return t;
    }

    void rename_neighbour(int t, int before, int after) { std::ranges::replace(across_[index(t)], before, after); }

    /// Replaces edge b–c of triangle t = (p, b, c), p the new point, by p–d if the apex d beyond b–c lies above the plane of t.
    void flip_where_not_convex(int t) {
        const auto [p, b, c] = at(t);
        const int s = across_[index(t)][0];
        const auto k = index(std::ranges::find(across_[index(s)], t) - across_[index(s)].begin());
        const int d = at(s)[k];
        if (!((point(b) - point(p)).cross(point(c) - point(p)).dot(point(d) - point(p)) > 0)) return;
        // s = (d, c, b) from its corner k: beyond d–c and beyond b–d.
        const int beyond_dc = across_[index(s)][(k + 2) % 3], beyond_bd = across_[index(s)][(k + 1) % 3];
        const int beyond_cp = across_[index(t)][1];
        at(t) = {p, b, d};
        across_[index(t)] = {beyond_bd, s, across_[index(t)][2]};
        at(s) = {p, d, c};
        across_[index(s)] = {beyond_dc, beyond_cp, t};
        rename_neighbour(beyond_bd, s, t);
        rename_neighbour(beyond_cp, t, s);
        pending_.push_back(t);
        pending_.push_back(s);
    }

    const Positions& X_;
    std::vector<std::array<int, 3>> vertices_;   // of each triangle
    std::vector<std::array<int, 3>> across_;     // the triangle beyond the edge opposite each corner
    std::vector<int> pending_;                   // triangles with an edge opposite corner 0 to be checked
    int last_ = 0;
};

}   // namespace

TriangleMesh random_sphere(int points, std::uint64_t seed) {
    if (points < 6) throw UsageError("a random sphere cannot have " + std::to_string(points) + " points", "ask for at least six");
    TriangleMesh mesh;
    mesh.X.resize(points, 3);
    mesh.X.topRows<6>() << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
    NormalNumbers random(seed);
    for (int i = 6; i < points; ++i) {
        // Archimedes: z is uniform, and so is the angle around it.
        const double z = 2 * random.uniform() - 1, angle = 2 * std::numbers::pi * random.uniform(), rho = std::sqrt(1 - z * z);
        mesh.X.row(i) << rho * std::cos(angle), rho * std::sin(angle), z;
    }
    GrowingHull hull(mesh.X);
    for (int i = 6; i < points; ++i) hull.insert(i);
    mesh.F = hull.faces();
    return mesh;
}

}   // namespace meshfolio
