#include "geometry/denoising/component_size.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/at.h"
#include "geometry/denoising/normal_filters.h"
#include "geometry/linear/special_values.h"
#include "mesh/orientation.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

/// Scales component c by factor[c] about its centroid and moves it to the centroid in `wanted`; a component of factor NaN stays.
Positions scaled_components(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& now, const ComponentSizes& wanted,
                            const Vector& factor) {
    const std::vector<int> component = component_of_vertices(topology);
    Positions X = mesh.X;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const int c = component[at(v)];
        if (c < 0 || !std::isfinite(factor[c])) continue;
        X.row(v) = wanted.centroid.row(c) + factor[c] * (mesh.X.row(v) - now.centroid.row(c));
    }
    return X;
}

}   // namespace

ComponentSizes component_sizes(const TriangleMesh& mesh, const MeshTopology& topology) {
    const int count = topology.component_count;
    const Vector areas = face_areas(mesh);
    const Positions centres = face_centroids(mesh);
    ComponentSizes sizes{Vector::Zero(count), component_volumes(mesh.F, mesh.X, topology), Positions::Zero(count, 3)};
    for (int t = 0; t < mesh.face_count(); ++t) {
        const int c = topology.component[at(t)];
        sizes.area[c] += areas[t];
        sizes.centroid.row(c) += areas[t] * centres.row(t);
    }
    for (int c = 0; c < count; ++c) sizes.centroid.row(c) /= sizes.area[c] > 0 ? sizes.area[c] : 1;
    const std::vector<int> out_of_balance = edges_out_of_balance_by_component(mesh, topology);
    for (int c = 0; c < count; ++c)
        if (out_of_balance[at(c)] > 0) sizes.volume[c] = undefined;
    return sizes;
}

Vector component_volumes(const Faces& F, const Positions& X, const MeshTopology& topology) {
    Vector six_volumes = Vector::Zero(topology.component_count);
    std::vector<int> seen_from(at(topology.component_count), -1);
    for (Eigen::Index begin = 0, end = 0; begin < F.rows(); begin = end) {
        const int c = topology.component[std::size_t(begin)];
        int& from = seen_from[at(c)];
        if (from < 0) from = F(begin, 0);
        const Vector3 origin = X.row(from);
        double sum = 0;
        for (; end < F.rows() && topology.component[std::size_t(end)] == c; ++end) {
            const auto corner = [&](int k) -> Vector3 { return X.row(F(end, k)).transpose() - origin; };
            sum += corner(0).dot(corner(1).cross(corner(2)));
        }
        six_volumes[c] += sum;
    }
    return six_volumes / 6;
}

std::vector<int> component_of_vertices(const MeshTopology& topology) {
    std::vector<int> component;
    for (int v = 0; v + 1 < std::ssize(topology.vertex_faces.start); ++v)
        component.push_back(topology.vertex_faces.size(v) > 0 ? topology.component[std::size_t(*topology.vertex_faces.begin(v))] : -1);
    return component;
}

bool has_volume_to_keep(const TriangleMesh& mesh, const MeshTopology& topology) {
    const Vector volume = component_sizes(mesh, topology).volume;
    return volume.size() > 0 && (volume.array().abs() > 1e-12 * std::pow(bounding_box(mesh).diagonal(), 3)).all();
}

Positions with_volumes(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted) {
    const ComponentSizes now = component_sizes(mesh, topology);
    Vector factor = wanted.volume.cwiseQuotient(now.volume);
    for (double& f : factor) f = f > 0 ? std::cbrt(f) : undefined;
    return scaled_components(mesh, topology, now, wanted, factor);
}

Positions with_areas(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted) {
    const ComponentSizes now = component_sizes(mesh, topology);
    return scaled_components(mesh, topology, now, wanted, wanted.area.cwiseQuotient(now.area).cwiseSqrt());
}

}   // namespace meshfolio
