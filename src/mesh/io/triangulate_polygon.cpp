#include "mesh/io/triangulate_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/errors.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

using Point = Eigen::Vector2d;

constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();   // of results from coordinates in [−1, 1]

/// Returns twice the signed area of the triangle a, b, c; 0 if it is within the rounding of coordinates in [−1, 1].
double turn(const Point& a, const Point& b, const Point& c) {
    const Point u = b - a, v = c - a;
    const double area = u.x() * v.y() - u.y() * v.x();
    const double noise = rounding * (u.lpNorm<1>() + v.lpNorm<1>());
    return std::abs(area) > noise ? area : 0;
}

/// Returns the corners in the plane of the Newell normal Σ xᵢ × xᵢ₊₁, in which the polygon runs counter-clockwise; empty if there is no
/// normal. They are relative to the first corner and scaled by a power of two into [−1, 1], so that neither place nor size matters.
std::vector<Point> flattened(const Positions& corners) {
    Positions X = corners.rowwise() - corners.row(0);
    const double size = X.cwiseAbs().maxCoeff();
    if (!(size > 0)) return {};
    X = X.unaryExpr([exponent = std::ilogb(size)](double x) { return std::ldexp(x, -exponent - 1); }).eval();
    Vector3 normal = Vector3::Zero();
    for (Eigen::Index i = 0; i + 1 < X.rows(); ++i) normal += X.row(i).cross(X.row(i + 1)).transpose();
    if (!(normal.norm() > 0)) return {};
    normal.normalize();
    // For a polygon in a coordinate plane, u and v are coordinate axes and nothing is rounded.
    Eigen::Index dominant = 0;
    normal.cwiseAbs().maxCoeff(&dominant);
    const Vector3 axis = Vector3::Unit((dominant + 1) % 3);
    const Vector3 u = (axis - axis.dot(normal) * normal).normalized(), v = normal.cross(u);
    std::vector<Point> points;
    for (Eigen::Index i = 0; i < X.rows(); ++i) points.emplace_back(X.row(i).dot(u), X.row(i).dot(v));
    return points;
}

/// True if the triangles (0, i, i+1) tile the polygon: all turn left, and together by less than half a turn around corner 0.
bool fan_is_valid(const std::vector<Point>& p) {
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        if (turn(p[0], p[i], p[i + 1]) <= 0 || turn(p[0], p[1], p[i + 1]) < 0) return false;
    return true;
}

/// Removes the spikes of a polygon: corners at which it turns back on itself. This keeps the area. Neighbours at one place become one
/// corner beside a removed spike, and everywhere if more than rounding is tolerated.
class SpikeRemover {
public:
    /// @param tolerance  largest width of a spike
    SpikeRemover(const std::vector<Point>& points, double tolerance) : p_(points), tolerance_(tolerance) {}

    /// Returns the corners that are left, none of them a spike.
    std::vector<int> run() {
        left_.resize(p_.size());
        std::iota(left_.begin(), left_.end(), 0);
        for (std::size_t before = 0; before != left_.size();) {
            before = left_.size();
            for (int half = 0; half < 2; ++half) {   // in the second pass, the ends of the list lie in its middle
                pass();
                std::ranges::rotate(left_, left_.begin() + std::ssize(left_) / 2);
            }
        }
        std::ranges::rotate(left_, std::ranges::min_element(left_));
        return left_;
    }

private:
    bool is_same_place(int a, int b) const { return (p_[at(a)] - p_[at(b)]).lpNorm<1>() <= tolerance_; }

    bool is_spike(int a, int b, int c) const {
        const Point u = p_[at(a)] - p_[at(b)], v = p_[at(c)] - p_[at(b)];
        return std::abs(u.x() * v.y() - u.y() * v.x()) <= tolerance_ * (u.lpNorm<1>() + v.lpNorm<1>()) && u.dot(v) > 0;
    }

    void pass() {
        std::vector<int> kept;
        for (const int corner : left_) {
            bool removed = false;
            while (remove_spike(kept, corner)) removed = true;
            removed |= tolerance_ > rounding;
            if (!removed || kept.empty() || !is_same_place(kept.back(), corner)) kept.push_back(corner);
        }
        left_ = std::move(kept);
    }

    /// Removes the last corners, all at one place, if they are a spike before the next corner. Returns true if they were.
    bool remove_spike(std::vector<int>& kept, int next) const {
        if (kept.empty() || is_same_place(kept.back(), next)) return false;
        const auto elsewhere = std::find_if(kept.rbegin(), kept.rend(), [&](int corner) { return !is_same_place(corner, kept.back()); });
        if (elsewhere == kept.rend() || !is_spike(*elsewhere, kept.back(), next)) return false;
        kept.erase(elsewhere.base(), kept.end());
        return true;
    }

    const std::vector<Point>& p_;
    double tolerance_;
    std::vector<int> left_;
};

Faces fan(int corners) {
    Faces triangles(corners - 2, 3);
    for (int i = 0; i < corners - 2; ++i) triangles.row(i) << 0, i + 1, i + 2;
    return triangles;
}

/// The chosen points in the cells of a grid, about one per cell, to find those in a box.
class PointGrid {
public:
    PointGrid(const std::vector<Point>& points, std::vector<int> chosen)
        : chosen_(std::move(chosen)), low_(chosen_.empty() ? points.front() : points[at(chosen_.front())]), high_(low_) {
        for (const int i : chosen_) {
            low_ = low_.cwiseMin(points[at(i)]);
            high_ = high_.cwiseMax(points[at(i)]);
        }
        side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(chosen_.size()))));
        std::vector<int> cell_of;
        for (const int i : chosen_) cell_of.push_back(place(points[at(i)], 1) * side_ + place(points[at(i)], 0));
        cells_ = grouped_by_row(side_ * side_, cell_of);
    }

    /// Returns the first point in the cells that meet the box for which `found` holds, or −1.
    template <class Found> int find(const Point& low, const Point& high, Found found) const {
        for (int row = place(low, 1); row <= place(high, 1); ++row) {
            const int *const first = cells_.begin(row * side_ + place(low, 0)), *const last = cells_.end(row * side_ + place(high, 0));
            for (const int* i = first; i != last; ++i)
                if (found(chosen_[at(*i)])) return chosen_[at(*i)];
        }
        return -1;
    }

private:
    int place(const Point& p, int axis) const {
        const double extent = high_[axis] - low_[axis];
        if (!(extent > 0)) return 0;
        return static_cast<int>(std::clamp((p[axis] - low_[axis]) / extent * side_, 0.0, side_ - 1.0));
    }

    std::vector<int> chosen_;
    Point low_, high_;
    int side_ = 1;      // cells along an axis
    Incidence cells_;   // numbers of chosen points in each cell
};

/// Cuts ears off until a triangle is left. An ear is a convex corner with no corner that is not convex inside its triangle. A corner that
/// is no ear because of such an obstacle waits for it, so each is checked again only when that may help.
class EarClipper {
public:
    explicit EarClipper(std::vector<Point> points) : p_(std::move(points)), count_(static_cast<int>(p_.size())), grid_(p_, not_convex(p_)) {
        for (int i = 0; i < count_; ++i) {
            next_.push_back((i + 1) % count_);
            previous_.push_back((i + count_ - 1) % count_);
        }
        for (int i = 0; i < count_; ++i) convex_.push_back(turn(p_[at(previous_[at(i)])], p_[at(i)], p_[at(next_[at(i)])]) > 0);
        gone_.assign(p_.size(), 0);
        waiting_.resize(p_.size());
        waits_for_.assign(p_.size(), nobody);
        is_queued_.resize(p_.size());
    }

    PolygonTriangles clip() {
        result_.triangles.resize(count_ - 2, 3);
        for (const Care care : {Care::no_touching, Care::no_overlap, Care::convex_only, Care::none}) {
            care_ = care;
            // Every second corner comes first: ears cut off one after the other would make a fan of slivers.
            for (std::vector<int>& corners : waiting_) corners.clear();
            for (const int parity : {0, 1})
                for (int i = parity; i < count_; i += 2) queue(i);
            while (!candidates_.empty() && done_ < count_ - 2) {
                const int corner = candidates_.front();
                candidates_.pop_front();
                is_queued_[at(corner)] = 0;
                if (gone_[at(corner)] == 0 && is_ear(corner)) cut_off(corner);
            }
            if (done_ == count_ - 2) break;
        }
        return result_;
    }

private:
    /// Conditions on a triangle to be cut off. Simple polygons need the first only, those that touch themselves the second.
    enum class Care { no_touching, no_overlap, convex_only, none };

    static std::vector<int> not_convex(const std::vector<Point>& p) {
        std::vector<int> corners;
        for (std::size_t i = 0, n = p.size(); i < n; ++i)
            if (turn(p[(i + n - 1) % n], p[i], p[(i + 1) % n]) <= 0) corners.push_back(static_cast<int>(i));
        return corners;
    }

    /// Queues a corner to be checked, unless it is queued already.
    void queue(int corner) {
        waits_for_[at(corner)] = nobody;
        if (gone_[at(corner)] != 0 || is_queued_[at(corner)] != 0) return;
        is_queued_[at(corner)] = 1;
        candidates_.push_back(corner);
    }

    bool is_ear(int corner) {
        if (care_ == Care::none || done_ == count_ - 3) return true;
        const Point &a = p_[at(previous_[at(corner)])], &b = p_[at(corner)], &c = p_[at(next_[at(corner)])];
        if (a == b || b == c || c == a) return true;   // of no area, wherever it lies
        if (convex_[at(corner)] == 0) return false;
        if (care_ == Care::convex_only) return true;
        const int obstacle = corner_within(corner);
        if (obstacle < 0) return true;
        waiting_[at(obstacle)].push_back(corner);
        waits_for_[at(corner)] = obstacle;
        return false;
    }

    /// Returns a corner that is not convex and lies within the triangle at `corner`, or −1.
    int corner_within(int corner) const {
        const Point &a = p_[at(previous_[at(corner)])], &b = p_[at(corner)], &c = p_[at(next_[at(corner)])];
        const auto within = [&](int i) {
            const Point& q = p_[at(i)];
            if (gone_[at(i)] != 0 || convex_[at(i)] != 0 || q == a || q == b || q == c) return false;
            const double least = std::min({turn(a, b, q), turn(b, c, q), turn(c, a, q)});
            return care_ == Care::no_touching ? least >= 0 : least > 0;
        };
        return grid_.find(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), within);
    }

    void cut_off(int corner) {
        const int before = previous_[at(corner)], after = next_[at(corner)];
        result_.triangles.row(done_++) << before, corner, after;
        if (care_ == Care::convex_only || turn(p_[at(before)], p_[at(corner)], p_[at(after)]) < 0) result_.simple = false;
        gone_[at(corner)] = 1;
        next_[at(before)] = after;
        previous_[at(after)] = before;
        wake(corner);
        for (const int neighbour : {before, after}) {
            convex_[at(neighbour)] = turn(p_[at(previous_[at(neighbour)])], p_[at(neighbour)], p_[at(next_[at(neighbour)])]) > 0;
            if (convex_[at(neighbour)] != 0) wake(neighbour);
            queue(neighbour);
        }
    }

    /// Queues the corners that wait for the obstacle.
    void wake(int obstacle) {
        for (const int corner : std::exchange(waiting_[at(obstacle)], {}))
            if (waits_for_[at(corner)] == obstacle) queue(corner);   // by now it may wait for another one
    }

    std::vector<Point> p_;
    int count_;
    PointGrid grid_;
    static constexpr int nobody = -1;
    std::vector<int> next_, previous_;
    std::vector<char> convex_, gone_, is_queued_;
    std::vector<std::vector<int>> waiting_;   // the corners that each obstacle keeps from being ears
    std::vector<int> waits_for_;              // the obstacle of each corner, or nobody
    std::deque<int> candidates_;
    Care care_ = Care::no_touching;
    PolygonTriangles result_;
    int done_ = 0;
};

/// Widths of spikes relative to the polygon's size: the rounding of arithmetic; then, for polygons that cross themselves, the rounding of
/// files with some nine digits, of floats, and of fewer digits.
constexpr std::array spike_tolerances{rounding, 1e-9, 1e-6, 1e-5};

}   // namespace

PolygonTriangles triangulated_polygon(const Positions& corners) {
    const int count = static_cast<int>(corners.rows());
    if (count < 3 || count > max_polygon_corners)
        throw MeshError("a polygon of " + std::to_string(count) + " corners cannot be triangulated",
                        "give 3 to " + std::to_string(max_polygon_corners) + " corners");
    if (count == 3) return {fan(count), true};
    const std::vector<Point> points = flattened(corners);
    if (points.empty()) return {fan(count), false};
    if (fan_is_valid(points)) return {fan(count), true};
    PolygonTriangles best;
    std::size_t corners_left = 0;
    for (const double tolerance : spike_tolerances) {
        const std::vector<int> left = SpikeRemover(points, tolerance).run();
        if (left.size() < 3) break;
        if (left.size() == corners_left) continue;
        std::vector<Point> chosen;
        for (const int corner : left) chosen.push_back(points[at(corner)]);
        const int rest = static_cast<int>(left.size());
        PolygonTriangles cut = rest == 3 || fan_is_valid(chosen) ? PolygonTriangles{fan(rest), true} : EarClipper(std::move(chosen)).clip();
        cut.triangles = cut.triangles.unaryExpr([&](int corner) { return left[at(corner)]; }).eval();
        cut.spikes = count - rest;
        if (cut.simple || corners_left == 0) best = std::move(cut);
        if (best.simple) return best;
        corners_left = left.size();
    }
    return corners_left > 0 ? best : PolygonTriangles{fan(count), false};
}

}   // namespace meshfolio
