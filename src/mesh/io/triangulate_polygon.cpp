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
#include "mesh/io/mesh_files.h"

namespace meshfolio {

namespace {

using Point = Eigen::Vector2d;

constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();   // of what is computed from coordinates within [−1, 1]

/// Twice the signed area of the triangle a, b, c; 0 where it cannot be told from the rounding of coordinates within [−1, 1].
double turn(const Point& a, const Point& b, const Point& c) {
    const Point u = b - a;
    const Point v = c - a;
    const double area = u.x() * v.y() - u.y() * v.x();
    const double noise = rounding * (u.lpNorm<1>() + v.lpNorm<1>());
    return std::abs(area) > noise ? area : 0;
}

/// The corners in the plane of the Newell normal Σ xᵢ × xᵢ₊₁, in which the polygon runs counter-clockwise. They are taken relative
/// to the first corner and scaled by a power of two into [−1, 1], so neither place nor size matters. Empty: no normal.
std::vector<Point> flattened(const Positions& corners) {
    Positions X = corners.rowwise() - corners.row(0);
    const double size = X.cwiseAbs().maxCoeff();
    if (!(size > 0)) return {};
    X = X.unaryExpr([exponent = std::ilogb(size)](double x) { return std::ldexp(x, -exponent - 1); }).eval();
    Vector3 normal = Vector3::Zero();
    for (Eigen::Index i = 0; i + 1 < X.rows(); ++i) normal += X.row(i).cross(X.row(i + 1)).transpose();
    if (!(normal.norm() > 0)) return {};
    normal.normalize();
    // In a coordinate plane u and v are coordinate axes and nothing is rounded.
    Eigen::Index dominant = 0;
    normal.cwiseAbs().maxCoeff(&dominant);
    const Vector3 axis = Vector3::Unit((dominant + 1) % 3);
    const Vector3 u = (axis - axis.dot(normal) * normal).normalized();
    const Vector3 v = normal.cross(u);
    std::vector<Point> points;
    points.reserve(at(static_cast<int>(X.rows())));
    for (Eigen::Index i = 0; i < X.rows(); ++i) points.emplace_back(X.row(i).dot(u), X.row(i).dot(v));
    return points;
}

/// Whether the triangles (0, i, i+1) tile the polygon: all turn left, and together by less than half a turn around corner 0.
bool fan_is_valid(const std::vector<Point>& p) {
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        if (turn(p[0], p[i], p[i + 1]) <= 0 || turn(p[0], p[1], p[i + 1]) < 0) return false;
    return true;
}

/// Finds the corners of a polygon that are spikes, at which it turns back on itself. Removing one keeps the area. Neighbours at one place
/// become one corner beside a removed spike, and everywhere where more than rounding is tolerated.
class SpikeRemover {
public:
    /// @param tolerance  a spike is no wider
    SpikeRemover(const std::vector<Point>& points, double tolerance) : p_(points), tolerance_(tolerance) {}

    /// The corners left when none is a spike any more.
    std::vector<int> run() {
        left_.resize(p_.size());
        std::iota(left_.begin(), left_.end(), 0);
        for (std::size_t before = 0; before != left_.size();) {
            before = left_.size();
            for (int half = 0; half < 2; ++half) {   // the second time the ends meet in the middle
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
            while (ends_in_spike(kept, corner)) removed = true;
            removed |= tolerance_ > rounding;
            if (!removed || kept.empty() || !is_same_place(kept.back(), corner)) kept.push_back(corner);
        }
        left_ = std::move(kept);
    }

    /// Takes off the last corners, all at one place, where they are a spike before the next corner.
    bool ends_in_spike(std::vector<int>& kept, int next) const {
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

/// The chosen points in the cells of a grid over them, about one a cell, to find those in a box.
class PointGrid {
public:
    PointGrid(const std::vector<Point>& points, const std::vector<int>& chosen)
        : low_(chosen.empty() ? points.front() : points[at(chosen.front())]), high_(low_) {
        for (const int i : chosen) {
            low_ = low_.cwiseMin(points[at(i)]);
            high_ = high_.cwiseMax(points[at(i)]);
        }
        cells_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(chosen.size()))));
        start_.assign(at(cells_ * cells_) + 1, 0);
        for (const int i : chosen) ++start_[at(cell(points[at(i)])) + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        item_.resize(chosen.size());
        std::vector<int> next(start_.begin(), start_.end() - 1);
        for (const int i : chosen) item_[at(next[at(cell(points[at(i)]))]++)] = i;
    }

    /// The first point in the cells that meet the box for which `found` holds, or −1.
    template <class Found>
    int find(const Point& low, const Point& high, Found found) const {
        for (int row = place(low, 1); row <= place(high, 1); ++row) {
            const int first = start_[at(row * cells_ + place(low, 0))];
            const int last = start_[at(row * cells_ + place(high, 0)) + 1];
            for (int i = first; i < last; ++i)
                if (found(item_[at(i)])) return item_[at(i)];
        }
        return -1;
    }

private:
    int place(const Point& p, int axis) const {
        const double extent = high_[axis] - low_[axis];
        if (!(extent > 0)) return 0;
        return static_cast<int>(std::clamp((p[axis] - low_[axis]) / extent * cells_, 0.0, cells_ - 1.0));
    }
    int cell(const Point& p) const { return place(p, 1) * cells_ + place(p, 0); }

    Point low_, high_;
    int cells_;
    std::vector<int> start_, item_;
};

/// Cuts ears off until a triangle is left. An ear is a convex corner whose triangle holds no corner that is not convex. A corner
/// that is not an ear because of another one waits for it, so each is looked at again only when that may help.
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
            line_up();
            if (clip_candidates()) break;
        }
        return result_;
    }

private:
    /// What a triangle must be to be cut off. A simple polygon needs the first only, one that touches itself the second.
    enum class Care { no_touching, no_overlap, convex_only, none };

    static std::vector<int> not_convex(const std::vector<Point>& p) {
        std::vector<int> corners;
        for (std::size_t i = 0, n = p.size(); i < n; ++i)
            if (turn(p[(i + n - 1) % n], p[i], p[(i + 1) % n]) <= 0) corners.push_back(static_cast<int>(i));
        return corners;
    }

    /// All corners left, every second one first: corners cut off one after the other would make a fan of slivers.
    void line_up() {
        for (std::vector<int>& corners : waiting_) corners.clear();
        for (const int parity : {0, 1})
            for (int i = parity; i < count_; i += 2) queue(i);
    }

    /// To be looked at once, however many reasons there are.
    void queue(int corner) {
        waits_for_[at(corner)] = nobody;
        if (gone_[at(corner)] != 0 || is_queued_[at(corner)] != 0) return;
        is_queued_[at(corner)] = 1;
        candidates_.push_back(corner);
    }

    bool clip_candidates() {
        while (!candidates_.empty() && done_ < count_ - 2) {
            const int corner = candidates_.front();
            candidates_.pop_front();
            is_queued_[at(corner)] = 0;
            if (gone_[at(corner)] == 0 && is_ear(corner)) cut_off(corner);
        }
        return done_ == count_ - 2;
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

    /// A corner that is not convex and lies within the triangle at `corner`, or −1.
    int corner_within(int corner) const {
        const Point& a = p_[at(previous_[at(corner)])];
        const Point& b = p_[at(corner)];
        const Point& c = p_[at(next_[at(corner)])];
        const auto within = [&](int i) {
            const Point& q = p_[at(i)];
            if (gone_[at(i)] != 0 || convex_[at(i)] != 0 || q == a || q == b || q == c) return false;
            const double least = std::min({turn(a, b, q), turn(b, c, q), turn(c, a, q)});
            return care_ == Care::no_touching ? least >= 0 : least > 0;
        };
        return grid_.find(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), within);
    }

    void cut_off(int corner) {
        const int before = previous_[at(corner)];
        const int after = next_[at(corner)];
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

    void wake(int obstacle) {
        for (const int corner : std::exchange(waiting_[at(obstacle)], {}))
            if (waits_for_[at(corner)] == obstacle) queue(corner);   // its neighbours may be others since, and its obstacle another one
    }

    std::vector<Point> p_;
    int count_;
    PointGrid grid_;
    static constexpr int nobody = -1;
    std::vector<int> next_, previous_;
    std::vector<char> convex_, gone_, is_queued_;
    std::vector<std::vector<int>> waiting_;   // for each corner, those it keeps from being ears
    std::vector<int> waits_for_;              // the one it waits for, or nobody
    std::deque<int> candidates_;
    Care care_ = Care::no_touching;
    PolygonTriangles result_;
    int done_ = 0;
};

/// Relative to the polygon's size. The first is what arithmetic rounds; a polygon that crosses itself is tried again with what files round,
/// written with some nine digits, as floats, or with fewer digits.
constexpr std::array spike_tolerances{rounding, 1e-9, 1e-6, 1e-5};

PolygonTriangles clipped(const std::vector<Point>& points, const std::vector<int>& left) {
    std::vector<Point> chosen;
    chosen.reserve(left.size());
    for (const int corner : left) chosen.push_back(points[at(corner)]);
    const int count = static_cast<int>(chosen.size());
    PolygonTriangles cut = count == 3 || fan_is_valid(chosen) ? PolygonTriangles{fan(count), true} : EarClipper(std::move(chosen)).clip();
    cut.triangles = cut.triangles.unaryExpr([&](int corner) { return left[at(corner)]; }).eval();
    cut.spikes = static_cast<int>(points.size()) - count;
    return cut;
}

}   // namespace

PolygonTriangles triangulated_polygon(const Positions& corners) {
    if (corners.rows() < 3 || corners.rows() > max_polygon_corners) {
        throw MeshError("polygon of " + std::to_string(corners.rows()) + " corners (limits 3 and " + std::to_string(max_polygon_corners) +
                        ")");
    }
    const int count = static_cast<int>(corners.rows());
    if (count == 3) return {fan(count), true};
    std::vector<Point> points = flattened(corners);
    if (points.empty()) return {fan(count), false};
    if (fan_is_valid(points)) return {fan(count), true};
    PolygonTriangles best;
    std::size_t corners_left = 0;
    for (const double tolerance : spike_tolerances) {
        const std::vector<int> left = SpikeRemover(points, tolerance).run();
        if (left.size() < 3) break;
        if (left.size() == corners_left) continue;
        PolygonTriangles cut = clipped(points, left);
        if (cut.simple || corners_left == 0) best = std::move(cut);
        if (best.simple) return best;
        corners_left = left.size();
    }
    return corners_left > 0 ? best : PolygonTriangles{fan(count), false};
}

Faces triangulate_polygon(const Positions& corners) { return triangulated_polygon(corners).triangles; }

}   // namespace meshfolio
