#include "geometry/measures/surface_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/parallel_tasks.h"
#include "geometry/measures/closest_point.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double pieces_wanted = 16384;
constexpr int triangles_a_task = 64;

/// Into how many parts the sides of each triangle are divided, and where its pieces begin in the list of all.
struct Pieces {
    std::vector<int> parts;
    std::vector<Eigen::Index> start;

    explicit Pieces(const Vector& areas) : start{0} {
        const double largest = areas.sum() / pieces_wanted;
        for (const double area : areas) {
            parts.push_back(area > 0 ? std::max(1, static_cast<int>(std::ceil(std::sqrt(area / largest)))) : 1);
            start.push_back(start.back() + Eigen::Index{parts.back()} * parts.back());
        }
    }
};

/// visit(centroid) of each of the k² pieces of a triangle.
template <class Visit>
void for_each_piece(const Eigen::Matrix3d& corners, int k, const Visit& visit) {
    const auto at = [&](int i, int j, double third) -> Vector3 {
        const double s = (i + third) / k, t = (j + third) / k;
        return corners.col(0) + s * (corners.col(1) - corners.col(0)) + t * (corners.col(2) - corners.col(0));
    };
    for (int i = 0; i < k; ++i) {
        for (int j = 0; i + j < k; ++j) {
            visit(at(i, j, 1.0 / 3));
            if (i + j + 1 < k) visit(at(i, j, 2.0 / 3));   // the one that stands on its tip
        }
    }
}

Vector vertex_distances(const TriangleMesh& from, const ClosestPoint& to) {
    std::vector<char> used(static_cast<std::size_t>(from.vertex_count()), 0);
    for (const int v : from.F.reshaped()) used[static_cast<std::size_t>(v)] = 1;
    Vector distances = Vector::Constant(from.vertex_count(), nothing);
    for_each_index(from.vertex_count(), [&](int v) {
        if (used[static_cast<std::size_t>(v)] != 0) distances[v] = std::sqrt(to.squared_distance(from.X.row(v)));
    });
    return distances;
}

/// Distances of the pieces, and the angles of their normals, NaN where a triangle has none. A step of r changes a distance by r at most,
/// so that those of the corners bound the search.
Vector measure_pieces(const TriangleMesh& from, const Pieces& pieces, const Vector& face_area, const ClosestPoint& to, DistancesTo& found) {
    const Positions normals = face_normals(from), normals_of_other = face_normals(to.mesh());
    const Eigen::Index count = pieces.start.back();
    Vector angles = Vector::Constant(count, nothing);
    found.of_pieces.resize(count);
    found.areas.resize(count);
    const auto measure_triangle = [&](int t) {
        const auto face = static_cast<std::size_t>(t);
        const Eigen::Matrix3d corners = from.X(from.F.row(t), Eigen::all).transpose();
        const Vector3 of_corners = found.of_vertices(from.F.row(t)), normal = normals.row(t);
        Eigen::Index piece = pieces.start[face];
        for_each_piece(corners, pieces.parts[face], [&](const Vector3& p) {
            const double bound = (of_corners.transpose() + (corners.colwise() - p).colwise().norm()).minCoeff();
            const ClosestPoint::Nearest nearest = to.nearest(p, 1.0001 * bound * bound);   // with room for rounding: some triangle is found
            found.of_pieces[piece] = std::sqrt(nearest.squared_distance);
            found.areas[piece] = face_area[t] / (pieces.parts[face] * pieces.parts[face]);
            const Vector3 other = nearest.triangle >= 0 ? Vector3(normals_of_other.row(nearest.triangle)) : Vector3::Zero();
            if (!normal.isZero(0) && !other.isZero(0)) angles[piece] = std::atan2(normal.cross(other).norm(), normal.dot(other));
            ++piece;
        });
    };
    for_each_task(static_cast<std::size_t>((from.face_count() - 1) / triangles_a_task + 1), [&](std::size_t task) {
        const int first = static_cast<int>(task) * triangles_a_task, last = std::min(first + triangles_a_task, from.face_count());
        for (int t = first; t < last; ++t) measure_triangle(t);
    });
    return angles;
}

DistancesTo distances_to(const ClosestPoint& to, const TriangleMesh& from) {
    DistancesTo found;
    const Vector face_area = face_areas(from);
    found.of_vertices = vertex_distances(from, to);
    const Vector angles = measure_pieces(from, Pieces(face_area), face_area, to, found);
    const double area = found.areas.sum();
    found.max = std::max(found.of_pieces.maxCoeff(), found.of_vertices.array().isNaN().select(0, found.of_vertices).maxCoeff());
    found.mean = found.areas.dot(found.of_pieces) / area;
    found.rms = std::sqrt(found.areas.dot(found.of_pieces.cwiseAbs2()) / area);
    const auto has_angle = !angles.array().isNaN();
    found.mean_normal_angle =
        has_angle.select(angles.array() * found.areas.array(), 0).sum() / has_angle.select(found.areas.array(), 0).sum();
    return found;
}

void scale_lengths(DistancesTo& distances, double factor) {
    for (Vector* lengths : {&distances.of_vertices, &distances.of_pieces}) *lengths *= factor;
    distances.areas *= factor * factor;
    for (double* length : {&distances.max, &distances.mean, &distances.rms}) *length *= factor;
}

}   // namespace

double SurfaceDistances::hausdorff() const { return std::max(a_to_b.max, b_to_a.max); }

SurfaceDistances surface_distances(const TriangleMesh& a, const TriangleMesh& b) {
    const UnitPair unit(a, b);
    const ClosestPoint surface_a(unit.a), surface_b(unit.b);
    SurfaceDistances distances{distances_to(surface_b, unit.a), distances_to(surface_a, unit.b)};
    for (DistancesTo* one : {&distances.a_to_b, &distances.b_to_a}) scale_lengths(*one, 1 / unit.scale);
    return distances;
}

Vector vertex_distances(const TriangleMesh& from, const TriangleMesh& to) {
    const UnitPair unit(from, to);
    return vertex_distances(unit.a, ClosestPoint(unit.b)) / unit.scale;
}

std::vector<double> area_histogram(const DistancesTo& distances, double high, int bins) {
    const double area = distances.areas.sum();
    if (!(area > 0)) return {};
    std::vector<double> shares(static_cast<std::size_t>(bins), 0);
    for (Eigen::Index i = 0; i < distances.areas.size(); ++i) {
        const double place = high > 0 ? bins * (distances.of_pieces[i] / high) : 0;
        shares[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, bins - 1))] += distances.areas[i] / area;
    }
    return shares;
}

}   // namespace meshfolio
