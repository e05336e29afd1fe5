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

ClosestPoint::Triangle::Triangle(const Vector3& x0, const Vector3& x1, const Vector3& x2) : corner(x0), along{x1 - x0, x2 - x0} {
    const double longest = std::max({along[0].squaredNorm(), along[1].squaredNorm(), (x2 - x1).squaredNorm()});
    normal = along[0].cross(along[1]);
    const double twice_area = normal.norm();
    is_flat = !(twice_area > 1e-12 * longest);   // its plane is rounding noise, and its edges are the triangle
    if (!is_flat) normal /= twice_area;
}

/// By the region of the plane that p lies over (Ericson 2005, Real-Time Collision Detection, 5.1.5).
double ClosestPoint::Triangle::squared_distance(const Vector3& p, double known_bound) const {
    const Vector3 from_a = p - corner;
    const auto &ab = along[0], &ac = along[1];
    if (is_flat) {
        const Vector3 b = corner + ab, c = corner + ac;
        return std::min(
            {squared_distance_to_segment(p, corner, b), squared_distance_to_segment(p, b, c), squared_distance_to_segment(p, c, corner)});
    }
    const double height = normal.dot(from_a);
    if (height * height >= known_bound) return known_bound;

    const double ab_a = ab.dot(from_a), ac_a = ac.dot(from_a);
    if (ab_a <= 0 && ac_a <= 0) return from_a.squaredNorm();
    const Vector3 from_b = from_a - ab, from_c = from_a - ac;
    const double ab_b = ab.dot(from_b), ac_b = ac.dot(from_b), ab_c = ab.dot(from_c), ac_c = ac.dot(from_c);
    if (ab_b >= 0 && ac_b <= ab_b) return from_b.squaredNorm();
    if (ac_c >= 0 && ab_c <= ac_c) return from_c.squaredNorm();
    // The weights of the corners, times twice the squared area: negative beyond the edge opposite.
    const double of_c = ab_a * ac_b - ab_b * ac_a, of_b = ab_c * ac_a - ab_a * ac_c, of_a = ab_b * ac_c - ab_c * ac_b;
    if (of_c <= 0 && ab_a >= 0 && ab_b <= 0) return (from_a - ab_a / (ab_a - ab_b) * ab).squaredNorm();
    if (of_b <= 0 && ac_a >= 0 && ac_c <= 0) return (from_a - ac_a / (ac_a - ac_c) * ac).squaredNorm();
    const double to_c = ac_b - ab_b, to_b = ab_c - ac_c;
    if (of_a <= 0 && to_c >= 0 && to_b >= 0) return (from_b - to_c / (to_c + to_b) * (ac - ab)).squaredNorm();
    return height * height;
}

double squared_distance_to_triangle(const Vector3& p, const Vector3& x0, const Vector3& x1, const Vector3& x2) {
    return ClosestPoint::Triangle(x0, x1, x2).squared_distance(p, infinity);
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
    for (const Placed& placed : order) {
        const Corners& x = triangles[static_cast<std::size_t>(placed.triangle)];
        triangles_.emplace_back(x[0], x[1], x[2]);
    }
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
        for (int i = node.first; i < node.first + node.count; ++i)
            nearest = std::min(nearest, triangles_[static_cast<std::size_t>(i)].squared_distance(p, nearest));
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
