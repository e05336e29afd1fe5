#include "geometry/measures/closest_point.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/errors.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

constexpr int triangles_in_a_leaf = 4;

double squared_distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
    const Vector3 along = b - a;
    const double squared_length = along.squaredNorm();
    const double t = squared_length > 0 ? std::clamp((p - a).dot(along) / squared_length, 0.0, 1.0) : 0;
    return (p - a - t * along).squaredNorm();
}

}   // namespace

double squared_distance_to_triangle(const Vector3& p, const Vector3& x0, const Vector3& x1, const Vector3& x2) {
    const std::array<Vector3, 3> corner{x0, x1, x2};
    const std::array<Vector3, 3> edge{x1 - x0, x2 - x1, x0 - x2};
    const Vector3 normal = edge[0].cross(edge[1]);
    const double longest = std::max({edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm()});

    bool over_the_inside = normal.norm() > 1e-12 * longest;   // else the plane is rounding noise, and the edges are the triangle
    for (std::size_t k = 0; k < 3 && over_the_inside; ++k) over_the_inside = normal.cross(edge[k]).dot(p - corner[k]) >= 0;
    if (over_the_inside) {
        const double height = normal.normalized().dot(p - x0);
        return height * height;
    }
    return std::min(
        {squared_distance_to_segment(p, x0, x1), squared_distance_to_segment(p, x1, x2), squared_distance_to_segment(p, x2, x0)});
}

double ClosestPoint::Node::squared_distance(const Vector3& p) const { return (p - p.cwiseMax(low).cwiseMin(high)).squaredNorm(); }

void ClosestPoint::Node::include(const Vector3& other_low, const Vector3& other_high) {
    low = low.cwiseMin(other_low);
    high = high.cwiseMax(other_high);
}

ClosestPoint::ClosestPoint(const TriangleMesh& mesh) {
    if (mesh.face_count() == 0) throw MeshError("ClosestPoint: a mesh without triangles has no surface");
    std::vector<Corners> triangles(static_cast<std::size_t>(mesh.face_count()));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) triangles[t][static_cast<std::size_t>(k)] = mesh.X.row(mesh.F(static_cast<Eigen::Index>(t), k));
    }
    std::vector<Placed> order(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        order[t] = {(triangles[t][0] + triangles[t][1] + triangles[t][2]) / 3, static_cast<int>(t)};
    nodes_.reserve(2 * triangles.size() / triangles_in_a_leaf + 2);
    build(order, triangles, 0, mesh.face_count());
    triangles_.reserve(triangles.size());
    for (const Placed& placed : order) triangles_.push_back(triangles[static_cast<std::size_t>(placed.triangle)]);
}

/// Splits [first, last) of `order` at the median along the longest side of the box of the centroids; returns the node's number.
int ClosestPoint::build(std::vector<Placed>& order, const std::vector<Corners>& triangles, int first, int last) {
    Node node{Vector3::Constant(infinity), Vector3::Constant(-infinity), first, last - first, 0};
    Vector3 centroid_low = node.low, centroid_high = node.high;
    const int number = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
    if (last - first <= triangles_in_a_leaf) {
        for (int place = first; place < last; ++place)
            for (const Vector3& x : triangles[static_cast<std::size_t>(order[static_cast<std::size_t>(place)].triangle)])
                nodes_.back().include(x, x);
        return number;
    }
    for (int place = first; place < last; ++place) {
        centroid_low = centroid_low.cwiseMin(order[static_cast<std::size_t>(place)].centroid);
        centroid_high = centroid_high.cwiseMax(order[static_cast<std::size_t>(place)].centroid);
    }

    Eigen::Index axis = 0;
    (centroid_high - centroid_low).maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                     [&](const Placed& s, const Placed& t) { return s.centroid[axis] < t.centroid[axis]; });
    build(order, triangles, first, middle);
    const int right = build(order, triangles, middle, last);
    Node& inner = nodes_[static_cast<std::size_t>(number)];
    inner.count = 0;
    inner.right = right;
    for (const int child : {number + 1, right})
        inner.include(nodes_[static_cast<std::size_t>(child)].low, nodes_[static_cast<std::size_t>(child)].high);
    return number;
}

double ClosestPoint::squared_distance(const Vector3& p, double known_bound, double enough) const {
    double nearest = known_bound;
    struct Visit {
        int node;
        double distance;   // squared, to the box
    };
    std::array<Visit, 128> pending;   // the tree is balanced: its depth stays below 32
    std::size_t size = 0;
    pending[size++] = {0, nodes_[0].squared_distance(p)};
    while (size > 0 && nearest > enough) {
        const Visit visit = pending[--size];
        if (visit.distance >= nearest) continue;
        const Node& node = nodes_[static_cast<std::size_t>(visit.node)];
        for (int i = node.first; i < node.first + node.count; ++i) {
            const Corners& x = triangles_[static_cast<std::size_t>(i)];
            nearest = std::min(nearest, squared_distance_to_triangle(p, x[0], x[1], x[2]));
        }
        if (node.count > 0) continue;
        const Visit left{visit.node + 1, nodes_[static_cast<std::size_t>(visit.node) + 1].squared_distance(p)};
        const Visit right{node.right, nodes_[static_cast<std::size_t>(node.right)].squared_distance(p)};
        const bool left_first = left.distance <= right.distance;
        pending[size++] = left_first ? right : left;
        pending[size++] = left_first ? left : right;
    }
    return nearest;
}

}   // namespace meshfolio
