#include "geometry/measures/mesh_error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "geometry/measures/closest_point.h"
#include "geometry/measures/shape_kernels.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/orientation.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

void require_same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
    if (a.X.rows() != b.X.rows()) {
        throw MeshError("the meshes differ: " + std::to_string(a.X.rows()) + " vertices against " + std::to_string(b.X.rows()),
                        "compare meshes with the same triangles");
    }
    if (a.F.rows() != b.F.rows()) {
        throw MeshError("the meshes differ: " + std::to_string(a.F.rows()) + " triangles against " + std::to_string(b.F.rows()),
                        "compare meshes with the same triangles");
    }
    for (Eigen::Index t = 0; t < a.F.rows(); ++t) {
        if (a.F.row(t) == b.F.row(t)) continue;
        throw MeshError("the meshes differ: triangle " + std::to_string(t) + " is not the same in both meshes",
                        "compare meshes with the same triangles");
    }
}

/// The largest distance of any of the points X from a surface, by branch and bound: a step of r changes a distance by r at most, so that
/// the distance of one point bounds those of all around it, and few must be measured.
class FarthestPoint {
public:
    /// @param bounds  of the distances
    FarthestPoint(const Positions& X, Vector bounds, const ClosestPoint& surface) : X_(X), bounds_(std::move(bounds)), surface_(surface) {
        order_.resize(static_cast<std::size_t>(X.rows()));
        std::iota(order_.begin(), order_.end(), 0);
    }
    double distance() {
        search(order_.begin(), order_.end());
        return farthest_;
    }

private:
    using Place = std::vector<int>::iterator;

    void search(Place first, Place last) {
        last = std::partition(first, last, [&](int i) { return bounds_[i] > farthest_; });
        if (first == last) return;
        const Place middle = first + (last - first) / 2;
        const int axis = longest_side(first, last);
        std::nth_element(first, middle, last, [&](int i, int j) { return X_(i, axis) < X_(j, axis); });
        measure(*middle, first, last);
        const auto largest_bound = [&](Place begin, Place end) {
            double largest = 0;
            for (; begin != end; ++begin) largest = std::max(largest, bounds_[*begin]);
            return largest;
        };
        const bool right_first = largest_bound(first, middle) < largest_bound(middle, last);
        if (right_first) search(middle, last);
        search(first, middle);
        if (!right_first) search(middle, last);
    }

    int longest_side(Place first, Place last) const {
        Eigen::RowVector3d low = X_.row(*first), high = low;
        for (; first != last; ++first) {
            low = low.cwiseMin(X_.row(*first));
            high = high.cwiseMax(X_.row(*first));
        }
        int axis = 0;
        (high - low).maxCoeff(&axis);
        return axis;
    }

    /// Point v, as exactly as it takes to leave out all of [first, last).
    void measure(int v, Place first, Place last) {
        double radius = 0;
        for (Place i = first; i != last; ++i) radius = std::max(radius, (X_.row(*i) - X_.row(v)).norm());
        const double enough = std::max(0.0, farthest_ - radius);
        const double distance = std::sqrt(surface_.squared_distance(X_.row(v), bounds_[v] * bounds_[v], enough * enough));
        farthest_ = std::max(farthest_, distance);
        for (; first != last; ++first) bounds_[*first] = std::min(bounds_[*first], distance + (X_.row(*first) - X_.row(v)).norm());
    }

    const Positions& X_;
    Vector bounds_;
    const ClosestPoint& surface_;
    std::vector<int> order_;
    double farthest_ = 0;
};

/// Angles between corresponding normals; rows of zeros, which have no direction, are left out. Means are NaN where none is left.
struct NormalAngles {
    double mean = 0, mean_squared = 0;
    int inverted = 0;
    NormalAngles(const Positions& a, const Positions& b) {
        int compared = 0;
        for (Eigen::Index t = 0; t < a.rows(); ++t) {
            const Vector3 n = a.row(t), m = b.row(t);
            if (n.isZero(0) || m.isZero(0)) continue;
            const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
            mean += angle;
            mean_squared += angle * angle;
            inverted += n.dot(m) < 0 ? 1 : 0;
            ++compared;
        }
        mean /= compared;
        mean_squared /= compared;
    }
};

}   // namespace

MeshDifference compare_meshes(const TriangleMesh& a, const TriangleMesh& b) {
    require_same_triangles(a, b);
    MeshDifference difference;
    difference.box_diagonal = bounding_box(a).diagonal();
    difference.rms = vertex_rms(a.X, b.X);
    const Vector squared = (a.X - b.X).rowwise().squaredNorm();
    if (squared.size() > 0) difference.max = std::sqrt(squared.maxCoeff());
    const Vector areas = vertex_areas(a, AreaForm::barycentric);
    if (areas.sum() > 0) difference.area_weighted_rms = std::sqrt((areas / areas.sum()).dot(squared));
    Positions normals = face_normals(a);
    for (int t = 0; t < a.face_count(); ++t)
        if (kind_of(a, t) == TriangleKind::zero_area) normals.row(t).setZero();
    const NormalAngles angles(normals, face_normals(b));
    difference.mean_normal_angle = angles.mean;
    difference.mean_squared_normal_angle = angles.mean_squared;
    difference.inverted_faces = angles.inverted;
    const MeshTopology topology = topology_without_edges(a);
    const double volume = enclosed_volume(a, topology);
    difference.volume_ratio = volume != 0 ? enclosed_volume(b, topology) / volume : std::numeric_limits<double>::quiet_NaN();
    difference.area_ratio = surface_area(b) / surface_area(a);
    return difference;
}

double hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b) {
    require_same_triangles(a, b);
    if (a.face_count() == 0) return 0;
    const UnitPair unit(a, b);
    Vector bounds = Vector::Zero(a.X.rows());   // no vertex is farther from the other surface than from its own place there
    for (const int v : a.F.reshaped()) bounds[v] = (unit.a.X.row(v) - unit.b.X.row(v)).norm();
    const ClosestPoint surface_a(unit.a), surface_b(unit.b);
    return std::max(FarthestPoint(unit.a.X, bounds, surface_b).distance(), FarthestPoint(unit.b.X, bounds, surface_a).distance()) /
           unit.scale;
}

double vertex_rms(const Positions& a, const Positions& b) {
    if (a.rows() != b.rows()) throw MeshError("vertex_rms: " + std::to_string(a.rows()) + " vertices against " + std::to_string(b.rows()));
    return a.rows() > 0 ? std::sqrt((a - b).squaredNorm() / static_cast<double>(a.rows())) : 0;
}

Vector shape_distances(const TriangleMesh& clean, const Positions& X) {
    if (clean.X.rows() != X.rows())
        throw MeshError("shape_distances: " + std::to_string(clean.X.rows()) + " vertices against " + std::to_string(X.rows()));
    Vector nearest = (X - clean.X).rowwise().squaredNorm();
    lower_to_shape(clean, X, nearest);
    return nearest.cwiseSqrt();
}

double shape_rms(const TriangleMesh& clean, const Positions& X) {
    return X.rows() > 0 ? shape_distances(clean, X).norm() / std::sqrt(static_cast<double>(X.rows())) : 0;
}

double mean_normal_angle(const Positions& a, const Positions& b) {
    if (a.rows() != b.rows())
        throw MeshError("mean_normal_angle: " + std::to_string(a.rows()) + " normals against " + std::to_string(b.rows()));
    return NormalAngles(a, b).mean;
}

double smallest_angle(const TriangleMesh& mesh) {
    return mesh.face_count() > 0 ? corner_angles(mesh).minCoeff() : std::numeric_limits<double>::quiet_NaN();
}

}   // namespace meshfolio
