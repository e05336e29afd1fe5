#include "geometry/measures/hausdorff.h"

#include "base/parallel.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"
#include "geometry/measures/convex_piece.h"

namespace meshfolio {
namespace {

constexpr int triangles_in_a_group = 32, smallest_batch = 64, largest_batch = 1 << 14, candidates_a_task = 16, most_passes = 3;
constexpr std::size_t most_pieces = 1 << 19;                                             // waiting, of one triangle: 160 MB
constexpr std::int64_t boxes_at_least = std::int64_t{1} << 24, boxes_a_triangle = 160;   // to open in all

/// The accuracy of the search.
struct Goal {
    double accuracy, rounding;
    /// Returns the bound at which a piece is done: none of its points needs to be distinguished from `found`.
    double at(double found) const { return std::max((1 + accuracy) * found - rounding, found + rounding); }
};

/// Branch and bound over the pieces of one triangle. With the nearest triangle T at a point of a piece:
///   d(x) ≤ |x − y| + d(y)            as distances are 1-Lipschitz,
///   d(x) ≤ max over corners d(·, T)  as the distance to a convex set is convex.
/// Pieces are cut along the planes through the sides of T, beyond which other triangles are nearer, and where two triangles are equally
/// near: between planes, where distances grow linearly, that ends after as many cuts as there are triangles nearby.
class TriangleSearch {
public:
    TriangleSearch(const ClosestPoint& to, const Goal& goal, double found, std::int64_t boxes)
        : to_(to), goal_(goal), found_(found), boxes_(boxes) {}

    void run(const Eigen::Matrix3d& corners, double bound) {
        Piece whole;
        for (int k = 0; k < 3; ++k) whole.add(corners.col(k));
        push(whole, bound);
        while (!pieces_.empty() && pieces_.size() < most_pieces && boxes_ > 0) {
            std::pop_heap(pieces_.begin(), pieces_.end());
            const Piece piece = pieces_.back();
            pieces_.pop_back();
            examine(piece);
        }
        complete_ &= pieces_.empty();
        if (!pieces_.empty()) settled_ = std::max(settled_, pieces_.front().bound);
        pieces_ = {};
    }
    double found() const { return found_; }
    double bound() const { return settled_; }
    bool complete() const { return complete_; }
    std::int64_t boxes_left() const { return boxes_; }

private:
    /// Finds the nearest triangle, or −1 if none is below `known`, and raises found_.
    ClosestPoint::Nearest measure(const Vector3& p, double known, double enough) {
        const double at_least = std::max(0.0, enough);
        const auto nearest = to_.nearest(p, known * known * (1 + 1e-9), at_least * at_least, std::max<std::int64_t>(boxes_, 64));
        boxes_ -= 1 + nearest.opened;
        if (nearest.triangle >= 0) found_ = std::max(found_, std::sqrt(nearest.squared_low));
        return nearest;
    }

    /// Queues a piece, or settles it. @param near  a triangle of the other surface for one more bound; −1: none
    void push(Piece piece, double bound, int near = -1) {
        if (piece.count < 3) return;
        piece.bound = bound;
        if (near >= 0) {
            double largest = 0;
            for (const Vector3& p : piece.points()) largest = std::max(largest, to_.distance_to(near, p));
            piece.bound = std::min(bound, largest);
        }
        if (piece.bound <= goal_.at(found_)) {
            settled_ = std::max(settled_, piece.bound);
            return;
        }
        pieces_.push_back(piece);
        std::push_heap(pieces_.begin(), pieces_.end());
    }

    void examine(const Piece& piece) {
        const Vector3 centre = piece.centre();
        const double radius = piece.radius(centre);
        const auto nearest = measure(centre, piece.bound + goal_.rounding, found_ - radius);
        double bound = std::min(piece.bound, std::sqrt(nearest.squared_distance) + radius);
        Piece::Values to_nearest{};
        int farthest = 0;
        if (nearest.triangle >= 0) {
            for (int i = 0; i < piece.count; ++i) {
                to_nearest[i] = to_.distance_to(nearest.triangle, piece.corners[i]);
                if (to_nearest[i] > to_nearest[farthest]) farthest = i;
            }
            bound = std::min(bound, to_nearest[farthest]);
        }
        if (bound <= goal_.at(found_) || nearest.triangle < 0) {
            settled_ = std::max(settled_, bound);
            complete_ &= nearest.triangle >= 0;
            return;
        }
        if (piece.count > Piece::most_corners_to_cut || piece.depth % 4 == 3) return halve(piece, centre, bound);
        if (cut_along_sides(piece, radius, nearest.triangle, bound)) return;
        const auto at_corner = measure(piece.corners[farthest], to_nearest[farthest] + goal_.rounding, found_);
        if (bound <= goal_.at(found_)) {
            settled_ = std::max(settled_, bound);
        } else if (!cut_where_equal(piece, to_nearest, nearest.triangle, at_corner.triangle, bound)) {
            halve(piece, centre, bound);
        }
    }

    void halve(const Piece& piece, const Vector3& centre, double bound) {
        const auto [inside, outside] = piece.halves(centre);
        push(inside, bound);
        push(outside, bound);
    }

    /// Cuts the piece along the planes through the sides of triangle t; returns false if none crosses it.
    bool cut_along_sides(const Piece& piece, double radius, int t, double bound) {
        Eigen::Matrix3d triangle;
        for (int k = 0; k < 3; ++k) triangle.col(k) = to_.mesh().X.row(to_.mesh().F(t, k));
        const Vector3 normal = (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0));
        if (radius > 2 * (triangle.colwise() - triangle.rowwise().mean()).colwise().norm().maxCoeff()) return false;
        Piece over = piece;
        bool any = false;
        for (int k = 0; k < 3; ++k) {
            const Vector3 start = triangle.col(k), inwards = normal.cross(triangle.col((k + 1) % 3) - start).normalized();
            Piece::Values inside{};
            for (int i = 0; i < over.count; ++i) inside[i] = inwards.dot(over.corners[i] - start);
            const auto [low, high] = std::minmax_element(inside.begin(), inside.begin() + over.count);
            if (!(*low<-0.25 * goal_.rounding&& * high> 0.25 * goal_.rounding)) continue;
            const auto [kept, beyond] = over.cut(inside);
            push(beyond, bound, t);
            over = kept;
            any = true;
        }
        if (any) push(over, bound, t);
        return any;
    }

    /// Cuts where the triangles t and u are equally far; returns false if no such line crosses the piece.
    bool cut_where_equal(const Piece& piece, const Piece::Values& to_t, int t, int u, double bound) {
        if (u < 0 || u == t) return false;
        Piece::Values nearer_to_u{};
        int changes = 0;
        for (int i = 0; i < piece.count; ++i) {
            nearer_to_u[i] = to_t[i] - to_.distance_to(u, piece.corners[i]);
            if (i > 0 && (nearer_to_u[i] > 0) != (nearer_to_u[i - 1] > 0)) ++changes;
        }
        if ((nearer_to_u[0] > 0) != (nearer_to_u[piece.count - 1] > 0)) ++changes;
        const auto [low, high] = std::minmax_element(nearer_to_u.begin(), nearer_to_u.begin() + piece.count);
        if (changes != 2 || *low > -goal_.rounding || *high < goal_.rounding) return false;
        const auto [of_u, of_t] = piece.cut(nearer_to_u);
        push(of_u, bound, u);
        push(of_t, bound, t);
        return true;
    }

    const ClosestPoint& to_;
    Goal goal_;
    double found_, settled_ = 0;
    std::int64_t boxes_;   // left to open
    bool complete_ = true;
    std::vector<Piece> pieces_;   // a heap, the largest bound first
};

/// A triangle that may hold the farthest point.
struct Candidate {
    double bound;
    DistanceSearch* search;
    int triangle;
};

/// Searches the best candidates first, in batches: each begins with the results of the earlier ones, for any number of processors.
class FarthestSearch {
public:
    FarthestSearch(DistanceSearch& one, DistanceSearch& other, const Goal& goal) : searches_{&one, &other}, goal_(goal) {
        std::int64_t triangles = 0;
        for (const DistanceSearch* search : searches_) {
            triangles += search->from.face_count();
            found_ = std::max(found_, search->found);
        }
        boxes_left_ = boxes_at_least + boxes_a_triangle * triangles;
        for (DistanceSearch* search : searches_)
            for (int t = 0; t < search->from.face_count(); ++t) keep_or_settle({search->bounds[t], search, t});
    }

    HausdorffDistance run() {
        for (int pass = 0; pass < most_passes && !waiting_.empty() && boxes_left_ > 0; ++pass) {
            std::vector<Candidate> candidates;
            candidates.swap(waiting_);
            std::stable_sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.bound > b.bound; });
            std::size_t size = smallest_batch;
            for (std::span<const Candidate> rest = candidates; !rest.empty(); size = std::min<std::size_t>(2 * size, largest_batch)) {
                if (rest.front().bound <= goal_.at(found_)) {
                    settled_ = std::max(settled_, rest.front().bound);
                    break;
                }
                const auto batch = rest.first(std::min(size, rest.size()));
                search(batch);
                rest = rest.subspan(batch.size());
            }
        }
        double bound = std::max(found_, settled_);
        for (const Candidate& candidate : waiting_) bound = std::max(bound, candidate.bound);
        return {found_, bound + goal_.rounding, bound <= goal_.at(found_)};
    }

private:
    void keep_or_settle(const Candidate& candidate) {
        if (candidate.bound > goal_.at(found_)) {
            waiting_.push_back(candidate);
        } else {
            settled_ = std::max(settled_, candidate.bound);
        }
    }

    void search(std::span<const Candidate> batch) {
        const std::int64_t share = std::max<std::int64_t>(boxes_left_, 0) / static_cast<std::int64_t>(batch.size());
        std::vector<TriangleSearch> searched;
        for (const Candidate& candidate : batch) searched.emplace_back(candidate.search->to, goal_, found_, share);
        for_each_task((batch.size() - 1) / candidates_a_task + 1, [&](std::size_t task) {
            for (std::size_t i = task * candidates_a_task; i < std::min((task + 1) * candidates_a_task, batch.size()); ++i) {
                const TriangleMesh& from = batch[i].search->from;
                searched[i].run(from.X(from.F.row(batch[i].triangle), Eigen::all).transpose(), batch[i].bound);
            }
        });
        const double before = found_;
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (searched[i].found() > before) batch[i].search->found = std::max(batch[i].search->found, searched[i].found());
            found_ = std::max(found_, searched[i].found());
            boxes_left_ -= share - searched[i].boxes_left();
            if (searched[i].complete()) {
                settled_ = std::max(settled_, searched[i].bound());
            } else {
                waiting_.push_back({searched[i].bound(), batch[i].search, batch[i].triangle});
            }
        }
    }

    std::array<DistanceSearch*, 2> searches_;
    Goal goal_;
    double found_ = 0, settled_ = 0;
    std::int64_t boxes_left_;
    std::vector<Candidate> waiting_;
};

/// Lowers search.bounds by the distance measured at one point of each group of triangles; sets search.found to the largest.
void bound_groups(DistanceSearch& search) {
    const TriangleMesh& from = search.from;
    const int groups = (from.face_count() - 1) / triangles_in_a_group + 1;
    Vector measured(groups);
    for_each_task(static_cast<std::size_t>(groups), [&](std::size_t task) {
        const int group = static_cast<int>(task), first = group * triangles_in_a_group;
        const int last = std::min(first + triangles_in_a_group, from.face_count());
        const Vector3 p = from.X.row(from.F(first, 0));
        const auto nearest = search.to.nearest(p, infinity, 0, boxes_at_least / 4 / groups + boxes_a_triangle);
        measured[group] = std::sqrt(nearest.squared_low);
        for (int t = first; t < last; ++t) {
            const double radius = (from.X(from.F.row(t), Eigen::all).rowwise() - p.transpose()).rowwise().norm().maxCoeff();
            search.bounds[t] = std::min(search.bounds[t], std::sqrt(nearest.squared_distance) + radius);
        }
    });
    search.found = measured.maxCoeff();
}

/// Returns a bound of the distances of each triangle between corresponding meshes: at most the largest displacement of its corners, as
/// |a(x) − b(x)| is convex.
Vector displacement_bounds(const TriangleMesh& from, const Vector& displacements) {
    Vector bounds(from.face_count());
    for (int t = 0; t < from.face_count(); ++t) bounds[t] = displacements(from.F.row(t)).maxCoeff();
    return bounds;
}

}   // namespace

HausdorffDistance enclose_farthest(DistanceSearch& one, DistanceSearch& other, double accuracy, double rounding) {
    return FarthestSearch(one, other, {accuracy, rounding}).run();
}

HausdorffDistance hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b, double accuracy) {
    if (a.face_count() == 0 && b.face_count() == 0) return {};
    const UnitPair unit(a, b);
    const ClosestPoint surface_a(unit.a), surface_b(unit.b);
    const bool correspond = a.F.rows() == b.F.rows() && a.X.rows() == b.X.rows() && a.F == b.F;
    const Vector displacements =
        correspond ? Vector((unit.a.X - unit.b.X).rowwise().norm()) : Vector::Constant(std::max(a.X.rows(), b.X.rows()), infinity);
    DistanceSearch to_b{surface_a.mesh(), surface_b, displacement_bounds(surface_a.mesh(), displacements)};
    DistanceSearch to_a{surface_b.mesh(), surface_a, displacement_bounds(surface_b.mesh(), displacements)};
    for (DistanceSearch* search : {&to_b, &to_a}) bound_groups(*search);
    HausdorffDistance found = enclose_farthest(to_b, to_a, accuracy, unit.rounding());
    found.distance /= unit.scale;
    found.bound /= unit.scale;
    return found;
}

}   // namespace meshfolio
