#include "geometry/measures/closest_point.h"

#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/measures/spatial_order.h"

namespace meshfolio {
namespace {

constexpr int triangles_in_a_leaf = 4, boxes_in_a_box = 8;

double squared_distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
    const Vector3 along = b - a;
    const double squared_length = along.squaredNorm();
    const double t = squared_length > 0 ? std::clamp((p - a).dot(along) / squared_length, 0.0, 1.0) : 0;
    return (p - a - t * along).squaredNorm();
}

/// Returns the squared distance from p to the triangle with the longest side ab, from the sides and, if p lies over the triangle, the
/// plane, in coordinates along ab and across. However narrow the triangle, they lose no more than rounding of the corners does, while a
/// normal could point anywhere.
double squared_distance_to_narrow_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    const double to_sides =
        std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c), squared_distance_to_segment(p, c, a)});
    const Vector3 along = b - a;
    const double squared_length = along.squaredNorm();
    if (!(squared_length > 0)) return to_sides;
    const double t = (p - a).dot(along) / squared_length, t_of_c = (c - a).dot(along) / squared_length;
    const Vector3 off = p - a - t * along, across = c - a - t_of_c * along;
    const double s = off.dot(across) / across.squaredNorm();   // NaN without any width
    const bool over = s >= 0 && t >= s * t_of_c && 1 - t >= s * (1 - t_of_c);
    return over ? std::min(to_sides, (off - s * across).squaredNorm()) : to_sides;
}

/// Returns `order`, in which equal triangles are adjacent, with the first of each only: no search could separate them.
std::vector<int> without_repeats(const TriangleMesh& mesh, const Positions& centroids, const std::vector<int>& order) {
    using Corners = std::array<std::array<double, 3>, 3>;
    const auto corners_of = [&](int t) {
        Corners corners;
        for (int k = 0; k < 3; ++k) std::copy_n(Vector3(mesh.X.row(mesh.F(t, k))).data(), 3, corners[at(k)].begin());
        std::sort(corners.begin(), corners.end());
        return std::pair{corners, t};
    };
    const double rounding = 8 * epsilon * centroids.cwiseAbs().maxCoeff();   // of centroids of the same corners in another order
    std::vector<int> distinct;
    std::vector<std::pair<Corners, int>> together;
    for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
        for (end = i + 1; end < order.size(); ++end)
            if ((centroids.row(order[end]) - centroids.row(order[end - 1])).cwiseAbs().maxCoeff() > rounding) break;
        if (end == i + 1) {
            distinct.push_back(order[i]);
            continue;
        }
        together.clear();
        for (std::size_t j = i; j < end; ++j) together.push_back(corners_of(order[j]));
        std::sort(together.begin(), together.end());
        for (std::size_t j = 0; j < together.size(); ++j)
            if (j == 0 || together[j].first != together[j - 1].first) distinct.push_back(together[j].second);
    }
    return distinct;
}

}   // namespace

// By the region of the plane below p (Ericson 2005, Real-Time Collision Detection, 5.1.5): its products keep twelve digits if the triangle
// is not much narrower than long and p is not far from it.
double squared_distance_to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c, double known_bound) {
    const Vector3 ab = b - a, ac = c - a, bc = c - b, from_a = p - a, normal = ab.cross(ac);
    const double squared_to_a = from_a.squaredNorm(), squared_twice_area = normal.squaredNorm();
    const double squared_ab = ab.squaredNorm(), squared_ac = ac.squaredNorm(), squared_bc = bc.squaredNorm();
    const double longest = std::max({squared_ab, squared_ac, squared_bc});
    if (!(squared_twice_area > longest * std::max(1e-6 * longest, 1e-18 * squared_to_a))) {
        if (squared_ab == longest) return squared_distance_to_narrow_triangle(p, a, b, c);
        return squared_bc == longest ? squared_distance_to_narrow_triangle(p, b, c, a) : squared_distance_to_narrow_triangle(p, c, a, b);
    }
    const double along_normal = normal.dot(from_a), squared_height = along_normal / squared_twice_area * along_normal;
    if (squared_height >= known_bound) return known_bound;

    const double ab_a = ab.dot(from_a), ac_a = ac.dot(from_a);
    if (ab_a <= 0 && ac_a <= 0) return squared_to_a;
    const Vector3 from_b = p - b, from_c = p - c;
    const double ab_b = ab.dot(from_b), ac_b = ac.dot(from_b), ab_c = ab.dot(from_c), ac_c = ac.dot(from_c);
    if (ab_b >= 0 && ac_b <= ab_b) return from_b.squaredNorm();
    if (ac_c >= 0 && ab_c <= ac_c) return from_c.squaredNorm();
    // The weights of the corners, times twice the squared area: negative beyond the edge opposite.
    const double of_c = ab_a * ac_b - ab_b * ac_a, of_b = ab_c * ac_a - ab_a * ac_c, of_a = ab_b * ac_c - ab_c * ac_b;
    if (of_c <= 0 && ab_a >= 0 && ab_b <= 0) return (from_a - ab_a / (ab_a - ab_b) * ab).squaredNorm();
    if (of_b <= 0 && ac_a >= 0 && ac_c <= 0) return (from_a - ac_a / (ac_a - ac_c) * ac).squaredNorm();
    const double to_c = ac_b - ab_b, to_b = ab_c - ac_c;
    if (of_a <= 0 && to_c >= 0 && to_b >= 0) return (from_b - to_c / (to_c + to_b) * bc).squaredNorm();
    return squared_height;
}

double ClosestPoint::to_triangle(const Vector3& p, int t, double known_bound) const {
    const auto corner = [&](int k) -> Vector3 { return mesh_.X.row(mesh_.F(t, k)); };
    return squared_distance_to_triangle(p, corner(0), corner(1), corner(2), known_bound);
}

// Sorting along a curve takes a tenth of the time of splitting at medians, and searches hardly take longer.
ClosestPoint::ClosestPoint(TriangleMesh mesh) : mesh_(std::move(mesh)) {
    int count = mesh_.face_count();
    if (count == 0) throw MeshError("a mesh without triangles has no surface to measure distances from", "take a mesh with triangles");
    Positions centroids(count, 3);
    for (int t = 0; t < count; ++t)
        centroids.row(t) = (mesh_.X.row(mesh_.F(t, 0)) + mesh_.X.row(mesh_.F(t, 1)) + mesh_.X.row(mesh_.F(t, 2))) / 3;
    mesh_.F = Faces(mesh_.F(without_repeats(mesh_, centroids, morton_order(centroids)), Eigen::all));
    count = mesh_.face_count();

    const TreeBox empty{Vector3::Constant(infinity), Vector3::Constant(-infinity)};
    const auto boxes_of = [&](std::size_t parts, int size) { return std::vector<TreeBox>((parts - 1) / at(size) + 1, empty); };
    levels_.push_back(boxes_of(at(count), triangles_in_a_leaf));
    for (int t = 0; t < count; ++t) {
        for (const int v : mesh_.F.row(t)) {
            const Vector3 x = mesh_.X.row(v);
            levels_[0][at(t / triangles_in_a_leaf)].include(x, x);
        }
    }
    while (levels_.back().size() > 1) {
        const std::vector<TreeBox>& below = levels_.back();
        std::vector<TreeBox> above = boxes_of(below.size(), boxes_in_a_box);
        for (std::size_t i = 0; i < below.size(); ++i) above[i / boxes_in_a_box].include(below[i].low, below[i].high);
        levels_.push_back(std::move(above));
    }
}

ClosestPoint::Nearest ClosestPoint::nearest(const Vector3& p, double known_bound, double enough, std::int64_t most) const {
    Nearest nearest{known_bound, -1, 0, 0};
    struct Visit {
        double distance;   // squared, to the box
        std::size_t level;
        int box;
    };
    std::array<Visit, 128> pending;   // at most seven of each level, and 2³¹ triangles make eleven levels
    std::size_t size = 0;
    pending[size++] = {levels_.back()[0].squared_distance(p), levels_.size() - 1, 0};
    while (size > 0 && nearest.squared_distance > enough && nearest.opened < most) {
        const Visit visit = pending[--size];
        if (visit.distance >= nearest.squared_distance) continue;
        ++nearest.opened;
        if (visit.level == 0) {
            const int first = visit.box * triangles_in_a_leaf, last = std::min(first + triangles_in_a_leaf, mesh_.face_count());
            for (int t = first; t < last; ++t) {
                const double distance = to_triangle(p, t, nearest.squared_distance);
                if (distance < nearest.squared_distance) nearest.squared_distance = distance, nearest.triangle = t;
            }
            continue;
        }
        const std::vector<TreeBox>& below = levels_[visit.level - 1];
        const int first = visit.box * boxes_in_a_box, last = std::min(first + boxes_in_a_box, static_cast<int>(below.size()));
        const std::size_t farthest = size;
        for (int i = first; i < last; ++i) {
            const Visit next{below[at(i)].squared_distance(p), visit.level - 1, i};
            if (next.distance >= nearest.squared_distance) continue;
            std::size_t place = size++;
            for (; place > farthest && pending[place - 1].distance < next.distance; --place) pending[place] = pending[place - 1];
            pending[place] = next;
        }
    }
    nearest.squared_low = nearest.squared_distance;
    if (nearest.opened >= most)
        for (std::size_t i = 0; i < size; ++i) nearest.squared_low = std::min(nearest.squared_low, pending[i].distance);
    return nearest;
}

}   // namespace meshfolio
