#include "geometry/measures/mesh_error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/errors.h"
#include "geometry/measures/closest_point.h"
#include "geometry/operators/triangle_shape.h"
#include "geometry/operators/vertex_areas.h"
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

/// max over the vertices of `from` of the distance to the surface of `to`, whose vertex i lies near vertex i of `from`: that vertex
/// bounds the distance, and vertices bounded by the maximum so far need no search. [length²]
double squared_one_sided_hausdorff(const Positions& from, const TriangleMesh& to, const std::vector<char>& in_use) {
    const ClosestPoint surface(to);
    double largest = 0;
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
        if (!in_use[static_cast<std::size_t>(i)]) continue;
        const double bound = (from.row(i) - to.X.row(i)).squaredNorm();
        if (bound > largest) largest = std::max(largest, surface.squared_distance(from.row(i), bound, largest));
    }
    return largest;
}

/// Angles between corresponding normals; triangles without area in either mesh have none and are left out.
void compare_normals(const TriangleMesh& a, const TriangleMesh& b, MeshDifference& difference) {
    const Positions normals_a = face_normals(a), normals_b = face_normals(b);
    int compared = 0;
    for (Eigen::Index t = 0; t < normals_a.rows(); ++t) {
        const Vector3 n = normals_a.row(t), m = normals_b.row(t);
        if (n.isZero(0) || m.isZero(0) || kind_of(a, static_cast<int>(t)) == TriangleKind::zero_area) continue;
        const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
        difference.mean_normal_angle += angle;
        difference.mean_squared_normal_angle += angle * angle;
        difference.inverted_faces += n.dot(m) < 0 ? 1 : 0;
        ++compared;
    }
    if (compared == 0) return;
    difference.mean_normal_angle /= compared;
    difference.mean_squared_normal_angle /= compared;
}

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
    compare_normals(a, b, difference);
    const double volume = signed_volume(a);
    difference.volume_ratio = volume != 0 ? signed_volume(b) / volume : std::numeric_limits<double>::quiet_NaN();
    difference.area_ratio = surface_area(b) / surface_area(a);
    return difference;
}

/// In coordinates centred and scaled by a power of two, so that no square overflows and far-away meshes lose nothing.
double hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b) {
    require_same_triangles(a, b);
    if (a.face_count() == 0) return 0;
    const double scale = std::min(unit_scale(a), unit_scale(b));
    const Vector3 centre = bounding_box(a).centre();
    const auto normalised = [&](const TriangleMesh& mesh) { return moved_to(mesh, scale * (mesh.X.rowwise() - centre.transpose())); };
    const TriangleMesh unit_a = normalised(a), unit_b = normalised(b);
    std::vector<char> in_use(static_cast<std::size_t>(a.X.rows()), 0);
    for (const int v : a.F.reshaped()) in_use[static_cast<std::size_t>(v)] = 1;
    const double squared =
        std::max(squared_one_sided_hausdorff(unit_a.X, unit_b, in_use), squared_one_sided_hausdorff(unit_b.X, unit_a, in_use));
    return std::sqrt(squared) / scale;
}

double vertex_rms(const Positions& a, const Positions& b) {
    if (a.rows() != b.rows()) {
        throw MeshError("vertex_rms: " + std::to_string(a.rows()) + " vertices against " + std::to_string(b.rows()));
    }
    return a.rows() > 0 ? std::sqrt((a - b).squaredNorm() / static_cast<double>(a.rows())) : 0;
}

Vector shape_distances(const TriangleMesh& clean, const Incidence& vertex_faces, const Positions& X) {
    if (clean.X.rows() != X.rows()) {
        throw MeshError("shape_distances: " + std::to_string(clean.X.rows()) + " vertices against " + std::to_string(X.rows()));
    }
    Vector distances(X.rows());
    for (int v = 0; v < clean.vertex_count(); ++v) {
        const Vector3 x = X.row(v);
        double nearest = (X.row(v) - clean.X.row(v)).squaredNorm();
        for (const int* t = vertex_faces.begin(v); t != vertex_faces.end(v); ++t) {
            const auto corner = [&](int k) -> Vector3 { return clean.X.row(clean.F(*t, k)); };
            nearest = std::min(nearest, ClosestPoint::Triangle(corner(0), corner(1), corner(2)).squared_distance(x, nearest));
        }
        distances[v] = std::sqrt(nearest);
    }
    return distances;
}

double shape_rms(const TriangleMesh& clean, const Incidence& vertex_faces, const Positions& X) {
    return X.rows() > 0 ? shape_distances(clean, vertex_faces, X).norm() / std::sqrt(static_cast<double>(X.rows())) : 0;
}

double mean_normal_angle(const Positions& a, const Positions& b) {
    if (a.rows() != b.rows()) {
        throw MeshError("mean_normal_angle: " + std::to_string(a.rows()) + " normals against " + std::to_string(b.rows()));
    }
    double sum = 0;
    int compared = 0;
    for (Eigen::Index f = 0; f < a.rows(); ++f) {
        const Vector3 n = a.row(f), m = b.row(f);
        if (n.isZero(0) || m.isZero(0)) continue;
        sum += std::atan2(n.cross(m).norm(), n.dot(m));
        ++compared;
    }
    return compared > 0 ? sum / compared : 0;
}

double smallest_angle(const TriangleMesh& mesh) {
    return mesh.face_count() > 0 ? corner_angles(mesh).minCoeff() : std::numeric_limits<double>::quiet_NaN();
}

}   // namespace meshfolio
