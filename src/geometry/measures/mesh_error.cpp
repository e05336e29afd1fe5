#include "geometry/measures/mesh_error.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/orientation.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

/// Angles between corresponding normals, without rows of zeros, which have no direction. Means are NaN if none is left.
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
    const auto differ = [](const std::string& how) {
        return MeshError("the meshes differ: " + how, "compare meshes with the same triangles");
    };
    if (a.X.rows() != b.X.rows())
        throw differ(std::to_string(a.X.rows()) + " vertices in one, " + std::to_string(b.X.rows()) + " in the other");
    if (a.F.rows() != b.F.rows())
        throw differ(std::to_string(a.F.rows()) + " triangles in one, " + std::to_string(b.F.rows()) + " in the other");
    for (int t = 0; t < a.face_count(); ++t)
        if (a.F.row(t) != b.F.row(t)) throw differ("triangle " + std::to_string(t) + " is not the same in both meshes");

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
    difference.volume_ratio = volume != 0 ? enclosed_volume(b, topology) / volume : undefined;
    difference.area_ratio = surface_area(b) / surface_area(a);
    return difference;
}

double vertex_rms(const Positions& a, const Positions& b) {
    if (a.rows() != b.rows())
        throw MeshError("vertex_rms: one mesh has " + std::to_string(a.rows()) + " vertices, the other " + std::to_string(b.rows()),
                        "compare meshes with the same vertices");
    return a.rows() > 0 ? std::sqrt((a - b).squaredNorm() / static_cast<double>(a.rows())) : 0;
}

double shape_rms(const TriangleMesh& clean, const Positions& X) {
    return X.rows() > 0 ? shape_distances(clean, X).norm() / std::sqrt(static_cast<double>(X.rows())) : 0;
}

double mean_normal_angle(const Positions& a, const Positions& b) {
    if (a.rows() != b.rows())
        throw MeshError(
            "mean_normal_angle: " + std::to_string(a.rows()) + " normals and " + std::to_string(b.rows()) + " to compare them with",
            "compare meshes with the same triangles");
    return NormalAngles(a, b).mean;
}

double smallest_angle(const TriangleMesh& mesh) { return mesh.face_count() > 0 ? corner_angles(mesh).minCoeff() : undefined; }

}   // namespace meshfolio
