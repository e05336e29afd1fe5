#include "geometry/measures/mesh_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/measures/mesh_laws.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

struct Operators {
    LaplaceBeltrami laplacian;
    Vector H, K;
};
Operators operators_of(const TriangleMesh& mesh, const MeshTopology& topology) {
    LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    Vector H = cotangent_mean_curvature(mesh, topology, laplacian), K = gaussian_curvature(mesh, topology, laplacian.M);
    return {std::move(laplacian), std::move(H), std::move(K)};
}

/// A power of two not below x > 0.
double power_of_two_above(double x) { return std::ldexp(1.0, std::ilogb(x) + 1); }

/// Largest |a·unit − b| over the largest |b|, where both are numbers.
double relative_change(const Vector& a, double unit, const Vector& b) {
    double change = 0, size = 0;
    for (Eigen::Index i = 0; i < b.size(); ++i) {
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
        change = std::max(change, std::abs(a[i] * unit - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return size > 0 ? change / size : 0;
}

}   // namespace

MeshFacts mesh_facts(const PreparedMesh& prepared) {
    const TriangleMesh& mesh = prepared.mesh;
    MeshFacts facts;
    facts.counts = prepared.preflight;
    facts.unreferenced_vertices = facts.counts.vertices - facts.counts.vertices_in_use;
    const CornerValues edges = edge_lengths(mesh);
    facts.shortest_edge = edges.minCoeff();
    facts.longest_edge = edges.maxCoeff();
    facts.smallest_angle = smallest_angle(mesh);
    const Box box{facts.counts.box_low, facts.counts.box_high};
    facts.diagonal = box.diagonal();
    facts.offset = box.centre().norm() / facts.diagonal;
    const Vector deficits = angle_deficit(mesh, prepared.topology);
    facts.total_deficit = total_deficit(deficits);
    facts.gauss_bonnet_residual = gauss_bonnet_error(deficits, facts.counts.euler_characteristic);
    if (facts.shortest_edge > 0) facts.coordinate_rounding = coordinate_spacing(mesh) / facts.shortest_edge;
    return facts;
}

double coordinate_spacing(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    const double farthest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    return std::nextafter(farthest, std::numeric_limits<double>::infinity()) - farthest;
}

double change_when_moved(const PreparedMesh& prepared, double scale) {
    const TriangleMesh& mesh = prepared.mesh;
    const Box box{prepared.preflight.box_low, prepared.preflight.box_high};
    const double unit = power_of_two_above(box.diagonal());
    const double away = std::ldexp(unit, 20);
    const Positions near = (mesh.X.rowwise() - box.centre().transpose()) / unit;   // within [−1, 1]
    const Positions far = near.array() * scale * unit + away * scale;              // rounded here
    const Positions back = far.array() / scale - away;                             // not here
    const Operators a = operators_of(moved_to(mesh, far), prepared.topology), b = operators_of(moved_to(mesh, back), prepared.topology);
    const Vector Ca = a.laplacian.C.coeffs(), Cb = b.laplacian.C.coeffs();
    return std::max({relative_change(Ca, 1, Cb), relative_change(a.laplacian.M, 1 / (scale * scale), b.laplacian.M),
                     relative_change(a.H, scale, b.H), relative_change(a.K, scale * scale, b.K)});
}

}   // namespace meshfolio
