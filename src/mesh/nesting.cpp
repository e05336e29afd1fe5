#include "mesh/nesting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include "base/at.h"
#include "mesh/mesh_topology.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

constexpr int most_sampled_faces = 4096;
constexpr long most_visits = 200'000'000;   // of boxes; some seconds

/// A binary tree over boxes, split at the median of their centres along the longest side.
class BoxTree {
public:
    explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        if (!boxes_.empty()) build(0, 0, order_.size());
    }

    /// Calls found(i) for each box i that passes wanted(box), until found returns false. Returns false in this case, else true. A box
    /// around others must pass wanted if one of them does.
    template <class Wanted, class Found> bool visit(const Wanted& wanted, const Found& found) const {
        return boxes_.empty() || visit(0, 0, order_.size(), wanted, found);
    }

private:
    static constexpr std::size_t leaf_size = 4;

    void build(std::size_t node, std::size_t begin, std::size_t end) {
        Box around = boxes_[at(order_[begin])];
        for (std::size_t i = begin; i < end; ++i) {
            around.low = around.low.cwiseMin(boxes_[at(order_[i])].low);
            around.high = around.high.cwiseMax(boxes_[at(order_[i])].high);
        }
        if (node >= around_.size()) around_.resize(2 * node + 1);
        around_[node] = around;
        if (end - begin <= leaf_size) return;
        int axis = 0;
        around.extent().maxCoeff(&axis);
        const auto place = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        const std::size_t middle = begin + (end - begin) / 2;
        std::nth_element(place(begin), place(middle), place(end), [&](int i, int j) {
            const double x = boxes_[at(i)].centre()[axis], y = boxes_[at(j)].centre()[axis];
            return std::pair(x, i) < std::pair(y, j);
        });
        build(2 * node + 1, begin, middle);
        build(2 * node + 2, middle, end);
    }

    template <class Wanted, class Found>
    bool visit(std::size_t node, std::size_t begin, std::size_t end, const Wanted& wanted, const Found& found) const {
        if (!wanted(around_[node])) return true;
        if (end - begin > leaf_size) {
            const std::size_t middle = begin + (end - begin) / 2;
            return visit(2 * node + 1, begin, middle, wanted, found) && visit(2 * node + 2, middle, end, wanted, found);
        }
        for (std::size_t i = begin; i < end; ++i)
            if (wanted(boxes_[at(order_[i])]) && !found(order_[i])) return false;
        return true;
    }

    std::vector<Box> boxes_, around_;   // `around_` as a heap: node k is around 2k + 1 and 2k + 2
    std::vector<int> order_;
};

/// The triangles of one shell, to find where points lie relative to it.
class ShellSurface {
public:
    ShellSurface(const TriangleMesh& mesh, const std::vector<char>& flip, const int* begin, const int* end, long& visits)
        : mesh_(mesh), flip_(flip), faces_(begin, end), visits_(visits), tree_(boxes_of(mesh, faces_)) {}

    /// Returns the signed crossings of the ray from p along an axis. Each is decided edge by edge, in the order of the edge's vertices, so
    /// that the ray hits exactly one of two triangles at an edge; a ray that meets an edge is moved to one side.
    int winding_number(const Vector3& p, int axis) const {
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        int sum = 0;
        const auto wanted = [&](const Box& box) {
            ++visits_;
            return box.low[x] <= p[x] && p[x] <= box.high[x] && box.low[y] <= p[y] && p[y] <= box.high[y] && box.high[axis] >= p[axis];
        };
        tree_.visit(wanted, [&](int i) {
            sum += crossing(faces_[at(i)], p, x, y);
            return true;
        });
        return sum;
    }

    bool is_outside(const Vector3& p) const { return winding_number(p, 2) == 0 && winding_number(p, 0) == 0; }

    /// True if p lies within a distance of a triangle of nonzero area.
    bool is_near(const Vector3& p, double distance) const {
        const auto wanted = [&](const Box& box) {
            ++visits_;
            return (box.low.array() <= p.array() + distance).all() && (box.high.array() >= p.array() - distance).all();
        };
        return !tree_.visit(wanted, [&](int i) { return !is_near(faces_[at(i)], p, distance); });
    }

private:
    static std::vector<Box> boxes_of(const TriangleMesh& mesh, const std::vector<int>& faces) {
        std::vector<Box> boxes;
        for (const int t : faces) {
            const auto corners = mesh.X(mesh.F.row(t), Eigen::all);
            boxes.push_back({corners.colwise().minCoeff(), corners.colwise().maxCoeff()});
        }
        return boxes;
    }

    Vector3 corner(int t, int k) const { return mesh_.X.row(mesh_.F(t, k)); }

    /// Returns the side of the projected edge from u to v on which p lies: 1 left, −1 right; p on it counts as moved by (ε, ε²).
    int side(const Vector3& p, int u, int v, int x, int y) const {
        if (u > v) return -side(p, v, u, x, y);
        const double ux = mesh_.X(u, x) - p[x], uy = mesh_.X(u, y) - p[y], vx = mesh_.X(v, x) - p[x], vy = mesh_.X(v, y) - p[y];
        for (const double value : {ux * vy - uy * vx, uy - vy, vx - ux})
            if (value != 0) return value > 0 ? 1 : -1;
        return 0;
    }

    /// Returns 1 or −1 if the ray from p crosses triangle t, else 0.
    int crossing(int t, const Vector3& p, int x, int y) const {
        const int a = mesh_.F(t, 0), b = mesh_.F(t, 1), c = mesh_.F(t, 2);
        const int s = side(p, a, b, x, y);
        if (s == 0 || side(p, b, c, x, y) != s || side(p, c, a, x, y) != s) return 0;
        const Vector3 n = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
        if (!(s * n.dot(corner(t, 0) - p) > 0)) return 0;   // behind
        return flip_[at(t)] != 0 ? -s : s;
    }

    bool is_near(int t, const Vector3& p, double distance) const {
        const Vector3 n = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
        if (!(std::abs(n.dot(p - corner(t, 0))) <= distance * n.norm())) return false;
        for (int k = 0; k < 3; ++k) {
            const Vector3 edge = corner(t, (k + 1) % 3) - corner(t, k);
            if (edge.cross(p - corner(t, k)).dot(n) < -distance * edge.norm() * n.norm()) return false;
        }
        return n.squaredNorm() > 0;
    }

    const TriangleMesh& mesh_;
    const std::vector<char>& flip_;
    std::vector<int> faces_;
    long& visits_;
    BoxTree tree_;
};

class Nesting {
public:
    Nesting(const TriangleMesh& mesh, const std::vector<char>& flip, const Shells& shells)
        : mesh_(mesh), flip_(flip), shells_(shells), faces_(grouped_by_row(count(), shells.of_face)), surfaces_(shells.sign.size()) {
        for (int s = 0; s < count(); ++s) {
            const Vector3 first = mesh_.X.row(mesh_.F(*faces_.begin(s), 0));
            Box box{first, first};
            for (const int* t = faces_.begin(s); t != faces_.end(s); ++t) {
                const auto corners = mesh_.X(mesh_.F.row(*t), Eigen::all);
                box.low = box.low.cwiseMin(corners.colwise().minCoeff().transpose());
                box.high = box.high.cwiseMax(corners.colwise().maxCoeff().transpose());
            }
            farthest_ = std::max({farthest_, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
            boxes_.push_back(box);
        }
    }

    std::vector<Turn> turns() {
        std::map<std::array<double, 11>, std::vector<int>> shells_in;   // copies of a shell in one place form a group
        for (int s = 0; s < count(); ++s) shells_in[numbers_of(s)].push_back(s);
        std::vector<Box> boxes;
        std::vector<std::vector<int>> groups;
        for (auto& [numbers, group] : shells_in) {
            boxes.push_back(boxes_[at(group.front())]);
            groups.push_back(std::move(group));
        }
        const BoxTree tree(std::move(boxes));
        std::vector<Turn> turns(at(count()), Turn::none);
        for (std::size_t g = 0; g < groups.size() && visits_ <= most_visits; ++g) {
            const std::vector<int> around = shells_around(groups[g], groups, tree);
            for (const int s : groups[g]) turns[at(s)] = turn_of(s, around, groups[g]);
        }
        if (visits_ > most_visits) turns.assign(at(count()), Turn::unknown);
        return turns;
    }

private:
    enum class Relation { outside, inside, same_place };

    int count() const { return static_cast<int>(shells_.sign.size()); }

    /// Returns box, number of faces, and moments of the corners: alike for shells of the same faces in the same order.
    std::array<double, 11> numbers_of(int s) const {
        const Box& box = boxes_[at(s)];
        Vector3 sum = Vector3::Zero();
        double squares = 0;
        for (const int* t = faces_.begin(s); t != faces_.end(s); ++t) {
            const auto corners = mesh_.X(mesh_.F.row(*t), Eigen::all);
            sum += corners.colwise().sum().transpose();
            squares += corners.squaredNorm();
        }
        return {box.low.x(), box.low.y(), box.low.z(), box.high.x(), box.high.y(), box.high.z(), double(faces_.size(s)),
                sum.x(),     sum.y(),     sum.z(),     squares};
    }

    /// Returns the distance up to which a point of shell s lies on a surface: coordinates in files seldom have more than seven digits.
    double tolerance(int s) const { return std::max(1e-6 * boxes_[at(s)].diagonal(), 0x1p-50 * farthest_); }

    /// Returns the shells of other groups with boxes around the box of this group.
    std::vector<int> shells_around(const std::vector<int>& group, const std::vector<std::vector<int>>& groups, const BoxTree& tree) {
        const Box& inner = boxes_[at(group.front())];
        const double t = tolerance(group.front());
        std::vector<int> around;
        const auto wanted = [&](const Box& box) {
            ++visits_;
            return (box.low.array() <= inner.low.array() + t).all() && (box.high.array() >= inner.high.array() - t).all();
        };
        tree.visit(wanted, [&](int other) {
            if (groups[at(other)].front() == group.front()) return true;
            visits_ += std::ssize(groups[at(other)]);
            around.insert(around.end(), groups[at(other)].begin(), groups[at(other)].end());
            return visits_ <= most_visits;
        });
        return around;
    }

    Turn turn_of(int s, const std::vector<int>& around, const std::vector<int>& group) {
        int depth = 0;
        std::vector<int> twins;   // in the same place up to the digits of a file, of opposite sign
        for (const int other : around) {
            if (visits_ > most_visits) return Turn::unknown;
            Relation relation = relation_of(s, other, tolerance(s), false);
            const bool is_twin = relation == Relation::same_place && shells_.sign[at(other)] == -shells_.sign[at(s)];
            if (is_twin) twins.push_back(other);
            if (relation == Relation::same_place && !is_twin) relation = exact_relation(s, other);
            if (relation == Relation::inside) ++depth;
        }
        if (!twins.empty() && depth % 2 == 1) return Turn::none;   // within a solid: a cavity and the body that fills it
        for (const int twin : twins) depth += exact_relation(s, twin) == Relation::inside ? 1 : 0;   // the two sides of a thin wall
        const int right_sign = depth % 2 == 0 ? 1 : -1;
        if (shells_.sign[at(s)] != -right_sign) return Turn::none;
        const auto opposite = std::ranges::find(group, right_sign, [&](int other) { return shells_.sign[at(other)]; });
        if (opposite != group.end() && relation_of(s, *opposite, tolerance(s), false) == Relation::same_place) return Turn::none;
        return right_sign > 0 ? Turn::outwards : Turn::inwards;
    }

    /// Returns the place of shell s relative to a shell that is nearer than the digits of most files, by all points of s.
    Relation exact_relation(int s, int other) { return relation_of(s, other, 0x1p-46 * farthest_, true); }

    /// Returns the place of shell s relative to shell `other`.
    /// @param near  points within this distance of the other shell do not count
    /// @param all  points inside and points outside together mean the same place, not outside
    Relation relation_of(int s, int other, double near, bool all) {
        auto& surface = surfaces_[at(other)];
        if (!surface) surface = std::make_unique<ShellSurface>(mesh_, flip_, faces_.begin(other), faces_.end(other), visits_);
        const int faces = faces_.size(s), step = (faces - 1) / most_sampled_faces + 1;
        Relation relation = Relation::same_place;
        for (int i = 0; i < faces; i += step) {
            const auto corners = mesh_.X(mesh_.F.row(faces_.begin(s)[i]), Eigen::all);
            const Vector3 centroid = corners.colwise().mean();
            for (const Vector3& p : {centroid, Vector3(corners.row(0)), Vector3(corners.row(1)), Vector3(corners.row(2))}) {
                const Relation here = surface->is_outside(p) ? Relation::outside : Relation::inside;
                if (here == relation || surface->is_near(p, near)) continue;
                if (all && relation != Relation::same_place) return Relation::same_place;
                if (here == Relation::outside && !all) return Relation::outside;
                relation = here;
            }
            if (visits_ > most_visits) break;
        }
        return relation;
    }

    const TriangleMesh& mesh_;
    const std::vector<char>& flip_;
    const Shells& shells_;
    Incidence faces_;                                       // of each shell
    std::vector<Box> boxes_;                                // of each shell
    std::vector<std::unique_ptr<ShellSurface>> surfaces_;   // built on demand
    double farthest_ = 0;                                   // largest magnitude of a coordinate
    long visits_ = 0;
};

}   // namespace

std::vector<Turn> turns_by_nesting(const TriangleMesh& mesh, const std::vector<char>& flip, const Shells& shells) {
    return Nesting(mesh, flip, shells).turns();
}

}   // namespace meshfolio
