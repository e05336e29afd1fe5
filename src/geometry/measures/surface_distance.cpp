#include "geometry/measures/surface_distance.h"

#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"
#include "geometry/measures/closest_point.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr double pieces_wanted = 16384;
constexpr int triangles_a_task = 64;

/// The division of triangles into pieces.
struct Pieces {
    std::vector<int> parts;            // of each side of a triangle
    std::vector<Eigen::Index> start;   // of its pieces in the list of all

    explicit Pieces(const Vector& areas) : start{0} {
        const double largest = areas.sum() / pieces_wanted;
        for (const double area : areas) {
            parts.push_back(area > 0 ? std::max(1, static_cast<int>(std::ceil(std::sqrt(area / largest)))) : 1);
            start.push_back(start.back() + Eigen::Index{parts.back()} * parts.back());
        }
    }
};

/// Calls visit(corners) for each of the k² pieces of a triangle.
template <class Visit> void for_each_piece(const Eigen::Matrix3d& corners, int k, const Visit& visit) {
    const auto point = [&](int i, int j) -> Vector3 {
        return corners.col(0) + (1.0 * i / k) * (corners.col(1) - corners.col(0)) + (1.0 * j / k) * (corners.col(2) - corners.col(0));
    };
    Eigen::Matrix3d piece;
    for (int i = 0; i < k; ++i) {
        for (int j = 0; i + j < k; ++j) {
            piece << point(i, j), point(i + 1, j), point(i, j + 1);
            visit(piece);
            if (i + j + 1 == k) continue;
            piece << point(i + 1, j + 1), point(i, j + 1), point(i + 1, j);   // stands on its tip
            visit(piece);
        }
    }
}

/// The boxes that each of many searches may open: a share, several times the usual number, and half of those saved so far.
class Allowance {
public:
    explicit Allowance(Eigen::Index searches) : share_(40 + (std::int64_t{1} << 23) / searches) {}
    std::int64_t next() const { return share_ + saved_ / 2; }
    void spend(std::int64_t boxes) { saved_ += share_ - boxes; }

private:
    std::int64_t share_, saved_ = 0;
};

struct VertexDistances {
    Vector high, low;   // n each, NaN if no triangle uses the vertex; they differ only if a search reached its limit [length]
};

VertexDistances measure_vertices(const TriangleMesh& from, const ClosestPoint& to) {
    std::vector<char> used(at(from.vertex_count()), 0);
    for (const int v : from.F.reshaped()) used[at(v)] = 1;
    VertexDistances found{Vector::Constant(from.vertex_count(), undefined), Vector::Constant(from.vertex_count(), undefined)};
    for_blocks(from.vertex_count(), [&](int, int begin, int end) {
        Allowance allowance(from.vertex_count());
        for (int v = begin; v < end; ++v) {
            if (used[at(v)] == 0) continue;
            const auto nearest = to.nearest(from.X.row(v), infinity, 0, allowance.next());
            allowance.spend(nearest.opened);
            found.high[v] = std::sqrt(nearest.squared_distance);
            found.low[v] = std::sqrt(nearest.squared_low);
        }
    });
    return found;
}

/// Bounds of the means of the distance d and of d² over a piece, and of d at any point of it.
struct PieceBounds {
    double d_low, d_high, squared_low, squared_high, largest;
};

/// Bounds a piece from d(c) = `nearest` at the centroid c, from the distances f of its corners to the triangle nearest to c, and from those
/// to the whole surface, `of_corners`, NaN if not known. As d is 1-Lipschitz and the mean of |x − c|² is s/36, s being the sum of the
/// squared sides, mean d ≥ d(c) − √s/6. As d ≤ f and f is convex, mean d ≤ Σf/3 and mean d² ≤ Σ_{i≤j} f_i f_j/6. As d² − |x|² is a minimum
/// of linear functions, thus concave, Σd²/3 − s/12 ≤ mean d² ≤ d²(c) + s/36, the first over the corners.
PieceBounds bounds_over(const Eigen::Matrix3d& corners, const ClosestPoint::Nearest& nearest, const Vector3& f, const Vector3& of_corners) {
    const Vector3 c = corners.rowwise().mean();
    const Eigen::Matrix3d from_centroid = corners.colwise() - c;
    const double s = 3 * from_centroid.squaredNorm();
    PieceBounds bounds{};
    const double radius = from_centroid.colwise().norm().maxCoeff();
    bounds.largest = std::min(std::sqrt(nearest.squared_distance) + radius, f.maxCoeff());
    bounds.squared_high = std::min(nearest.squared_distance + s / 36, (f.sum() * f.sum() + f.squaredNorm()) / 12);
    bounds.d_high = std::min(std::sqrt(bounds.squared_high), f.mean());
    bounds.d_low = std::max(0.0, std::sqrt(nearest.squared_low) - std::sqrt(s) / 6);
    const double by_corners = of_corners.squaredNorm() / 3 - s / 12;
    bounds.squared_low = std::fmax(bounds.d_low * bounds.d_low, by_corners);
    const double least = std::max(0.0, std::sqrt(nearest.squared_low) - radius);
    const double chord =
        (by_corners + least * bounds.largest) / (least + bounds.largest);   // √ lies above its chord from least² to largest²
    bounds.d_low = std::fmax(bounds.d_low, chord);
    return bounds;
}

/// The measures of one direction.
struct Measured {
    DistancesTo found;
    Vector angles;   // between normals, one a piece; NaN if a triangle has none [rad]
    Eigen::Matrix<double, -1, 4>
        of_area;      // areas times bounds, summed over the pieces of each triangle: d_low, d_high, squared_low, squared_high
    Vector bounds;    // of the distance of all points of each triangle
    Vector cut_off;   // searches that reached their limit, of each triangle
};

/// Measures all pieces. A step of r changes a distance by at most r, so that those of the corners bound the search.
void measure_pieces(const TriangleMesh& from, const Pieces& pieces, const Vector& face_area, const ClosestPoint& to,
                    const Vector& vertex_low, Measured& measured) {
    const Positions normals = face_normals(from), normals_of_other = face_normals(to.mesh());
    const auto measure_triangle = [&](int t, Allowance& allowance) {
        const int parts = pieces.parts[at(t)];
        const Eigen::Matrix3d corners = from.X(from.F.row(t), Eigen::all).transpose();
        const Vector3 of_corners = measured.found.of_vertices(from.F.row(t)), normal = normals.row(t);
        const Vector3 low = parts == 1 ? Vector3(vertex_low(from.F.row(t))) : Vector3::Constant(undefined);
        const double area = face_area[t] / (parts * parts);
        Eigen::Index piece = pieces.start[at(t)];
        for_each_piece(corners, parts, [&](const Eigen::Matrix3d& part) {
            const Vector3 p = part.rowwise().mean();
            const double bound = (of_corners.transpose() + (corners.colwise() - p).colwise().norm()).minCoeff();
            const auto nearest = to.nearest(p, 1.0001 * bound * bound, 0, allowance.next());   // above rounding: some triangle is found
            allowance.spend(nearest.opened);
            measured.found.of_pieces[piece] = std::sqrt(nearest.squared_distance);
            measured.found.areas[piece] = area;
            measured.cut_off[t] += nearest.squared_low < nearest.squared_distance ? 1 : 0;
            const Vector3 other = nearest.triangle >= 0 ? Vector3(normals_of_other.row(nearest.triangle)) : Vector3::Zero();
            if (!normal.isZero(0) && !other.isZero(0)) measured.angles[piece] = std::atan2(normal.cross(other).norm(), normal.dot(other));
            Vector3 f = Vector3::Constant(infinity);
            for (int k = 0; k < 3 && nearest.triangle >= 0; ++k) f[k] = to.distance_to(nearest.triangle, part.col(k));
            const PieceBounds bounds = bounds_over(part, nearest, f, low);
            measured.of_area.row(t) += area * Eigen::RowVector4d(bounds.d_low, bounds.d_high, bounds.squared_low, bounds.squared_high);
            measured.bounds[t] = std::max(measured.bounds[t], bounds.largest);
            ++piece;
        });
    };
    for_each_task(static_cast<std::size_t>((from.face_count() - 1) / triangles_a_task + 1), [&](std::size_t task) {
        const int first = static_cast<int>(task) * triangles_a_task, last = std::min(first + triangles_a_task, from.face_count());
        Allowance allowance(pieces.start.back());
        for (int t = first; t < last; ++t) measure_triangle(t, allowance);
    });
}

/// Returns the largest error of a value that lies between the bounds; NaN for NaN.
double error_of(double value, double low, double high) { return std::max({0.0, value - low, high - value}) + 0 * value; }

Measured measured_from(const TriangleMesh& from, const ClosestPoint& to) {
    const Vector face_area = face_areas(from);
    const Pieces pieces(face_area);
    const VertexDistances vertices = measure_vertices(from, to);
    const Eigen::Index triangles = from.F.rows(), count = pieces.start.back();
    Measured measured{.found = {},
                      .angles = Vector::Constant(count, undefined),
                      .of_area = decltype(Measured::of_area)::Zero(triangles, 4),
                      .bounds = Vector::Zero(triangles),
                      .cut_off = Vector::Zero(triangles)};
    DistancesTo& found = measured.found;
    found.of_vertices = vertices.high;
    found.of_pieces.resize(count);
    found.areas.resize(count);
    measure_pieces(from, pieces, face_area, to, vertices.low, measured);
    const double area = found.areas.sum();
    found.exact = measured.cut_off.isZero(0) && (vertices.low.array() < vertices.high.array()).count() == 0;
    found.max = vertices.low.array().isNaN().select(0, vertices.low).maxCoeff();
    if (measured.cut_off.isZero(0)) found.max = std::max(found.max, found.of_pieces.maxCoeff());
    found.mean = found.areas.dot(found.of_pieces) / area;
    found.rms = std::sqrt(found.areas.dot(found.of_pieces.cwiseAbs2()) / area);
    const Eigen::RowVector4d means = measured.of_area.colwise().sum() / area;
    found.mean_error = error_of(found.mean, means[0], means[1]);
    found.rms_error = error_of(found.rms, std::sqrt(means[2]), std::sqrt(means[3]));
    const auto has_angle = !measured.angles.array().isNaN();
    found.mean_normal_angle =
        has_angle.select(measured.angles.array() * found.areas.array(), 0).sum() / has_angle.select(found.areas.array(), 0).sum();
    return measured;
}

}   // namespace

SurfaceDistances surface_distances(const TriangleMesh& a, const TriangleMesh& b, double accuracy) {
    const UnitPair unit(a, b);
    const ClosestPoint surface_a(unit.a), surface_b(unit.b);
    Measured from_a = measured_from(unit.a, surface_b), from_b = measured_from(unit.b, surface_a);
    DistanceSearch to_b{unit.a, surface_b, std::move(from_a.bounds), from_a.found.max};
    DistanceSearch to_a{unit.b, surface_a, std::move(from_b.bounds), from_b.found.max};
    HausdorffDistance hausdorff = enclose_farthest(to_b, to_a, accuracy, unit.rounding());
    for (DistancesTo* one : {&from_a.found, &from_b.found}) {
        one->mean_error = std::min(one->mean_error, std::max(one->mean, hausdorff.bound - one->mean)) + unit.rounding();
        one->rms_error = std::min(one->rms_error, std::max(one->rms, hausdorff.bound - one->rms)) + unit.rounding();
    }
    from_a.found.max = to_b.found;
    from_b.found.max = to_a.found;
    const double factor = 1 / unit.scale;
    for (DistancesTo* one : {&from_a.found, &from_b.found}) {
        for (Vector* lengths : {&one->of_vertices, &one->of_pieces}) *lengths *= factor;
        one->areas *= factor * factor;
        for (double* length : {&one->max, &one->mean, &one->rms, &one->mean_error, &one->rms_error}) *length *= factor;
    }
    hausdorff.distance /= unit.scale;
    hausdorff.bound /= unit.scale;
    return {std::move(from_a.found), std::move(from_b.found), hausdorff};
}

Vector vertex_distances(const TriangleMesh& from, const TriangleMesh& to) {
    const UnitPair unit(from, to);
    return measure_vertices(unit.a, ClosestPoint(unit.b)).high / unit.scale;
}

std::vector<double> area_histogram(const DistancesTo& distances, double high, int bins) {
    const double area = distances.areas.sum();
    if (!(area > 0)) return {};
    std::vector<double> shares(at(bins), 0);
    for (Eigen::Index i = 0; i < distances.areas.size(); ++i) {
        const double place = high > 0 ? bins * (distances.of_pieces[i] / high) : 0;
        shares[at(std::clamp(static_cast<int>(place), 0, bins - 1))] += distances.areas[i] / area;
    }
    return shares;
}

}   // namespace meshfolio
