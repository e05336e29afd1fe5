#include "mesh/samples/implicit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/at.h"
#include "mesh/edge_flips.h"

namespace meshfolio {

namespace {

/// Values of f on the nodes of a grid, and the net of its zero set.
class Net {
public:
    Net(ImplicitFunction f, const Box& box, double cell) : low_(box.low), cell_(cell) {
        for (int axis = 0; axis < 3; ++axis) nodes_[axis] = 2 + static_cast<int>(std::ceil(box.extent()[axis] / cell));
        value_.resize(at(nodes_.prod()));
        vertex_.assign(value_.size(), -1);
        for_each_node([&](const Eigen::Vector3i& n) { value_[slot(n)] = f(place(n)); });
    }

    TriangleMesh mesh() {
        for_each_node([&](const Eigen::Vector3i& n) {
            if ((n.array() + 1 < nodes_.array()).all()) add_vertex(n);
        });
        for_each_node([&](const Eigen::Vector3i& n) {
            for (int axis = 0; axis < 3; ++axis) add_quad(n, axis);
        });
        TriangleMesh net;
        net.X = Eigen::Map<const Positions>(coordinates_.data(), static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
        net.F = Eigen::Map<const Faces>(corners_.data(), static_cast<Eigen::Index>(corners_.size() / 3), 3);
        return net;
    }

private:
    template <class Action> void for_each_node(Action action) const {
        for (int k = 0; k < nodes_[2]; ++k)
            for (int j = 0; j < nodes_[1]; ++j)
                for (int i = 0; i < nodes_[0]; ++i) action(Eigen::Vector3i(i, j, k));
    }

    std::size_t slot(const Eigen::Vector3i& n) const { return at((n[2] * nodes_[1] + n[1]) * nodes_[0] + n[0]); }
    Vector3 place(const Eigen::Vector3i& n) const { return low_ + cell_ * n.cast<double>(); }
    double value(const Eigen::Vector3i& n) const { return value_[slot(n)]; }
    bool cut(const Eigen::Vector3i& a, const Eigen::Vector3i& b) const { return (value(a) < 0) != (value(b) < 0); }

    /// Adds the mean of the zeros on the twelve edges of the cell above node n, if there are any.
    void add_vertex(const Eigen::Vector3i& n) {
        Vector3 sum = Vector3::Zero();
        int zeros = 0;
        for (int axis = 0; axis < 3; ++axis) {
            for (int corner = 0; corner < 4; ++corner) {
                Eigen::Vector3i a = n;
                a[(axis + 1) % 3] += corner & 1;
                a[(axis + 2) % 3] += corner >> 1;
                const Eigen::Vector3i b = a + Eigen::Vector3i::Unit(axis);
                if (!cut(a, b)) continue;
                sum += place(a) + value(a) / (value(a) - value(b)) * (place(b) - place(a));
                ++zeros;
            }
        }
        if (zeros == 0) return;
        vertex_[slot(n)] = static_cast<int>(coordinates_.size() / 3);
        for (const double x : Vector3(sum / zeros)) coordinates_.push_back(x);
    }

    /// Adds the quad of the four cells around the grid edge from node n along an axis, if f changes sign on that edge.
    void add_quad(const Eigen::Vector3i& n, int axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (n[axis] + 1 >= nodes_[axis] || n[u] == 0 || n[v] == 0 || n[u] + 1 >= nodes_[u] || n[v] + 1 >= nodes_[v]) return;
        if (!cut(n, n + Eigen::Vector3i::Unit(axis))) return;
        const Eigen::Vector3i back_u = Eigen::Vector3i::Unit(u), back_v = Eigen::Vector3i::Unit(v);
        std::array<int, 4> q{vertex_[slot(n - back_u - back_v)], vertex_[slot(n - back_v)], vertex_[slot(n)], vertex_[slot(n - back_u)]};
        if (value(n) >= 0) std::swap(q[1], q[3]);   // inside lies further along the axis: the normal points back
        corners_.insert(corners_.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    }

    Vector3 low_;
    double cell_;
    Eigen::Vector3i nodes_;
    std::vector<double> value_;         // of each node
    std::vector<int> vertex_;           // of the cell above each node; −1: not cut
    std::vector<double> coordinates_;   // x y z of each vertex
    std::vector<int> corners_;          // three of each triangle
};

}   // namespace

Vector3 projected(ImplicitFunction f, Vector3 p, int steps) {
    constexpr double difference = 1e-5;   // for gradients of shapes of size about 1
    for (int i = 0; i < steps; ++i) {
        Vector3 gradient;
        for (int axis = 0; axis < 3; ++axis) {
            const Vector3 step = difference * Vector3::Unit(axis);
            gradient[axis] = (f(p + step) - f(p - step)) / (2 * difference);
        }
        p -= f(p) / gradient.squaredNorm() * gradient;
    }
    return p;
}

TriangleMesh surface_net(ImplicitFunction f, const Box& box, double cell) { return Net(f, box, cell).mesh(); }

TriangleMesh relaxed_on(ImplicitFunction f, TriangleMesh mesh, int rounds) {
    constexpr int final_steps = 4;
    for (int round = 0; round < rounds; ++round) {
        mesh.F = delaunay_flipped(mesh, 2);
        mesh.X += steps_to_ring_centroids(mesh);   // its normal part is undone by the projection
        const int steps = round + 1 < rounds ? 1 : final_steps;
        for (int v = 0; v < mesh.vertex_count(); ++v) mesh.X.row(v) = projected(f, mesh.X.row(v), steps);
    }
    return mesh;
}

}   // namespace meshfolio
