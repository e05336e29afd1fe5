#include "geometry/measures/mesh_laws.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <numeric>

#include "geometry/linear/special_values.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

double largest_entry(const SparseMatrix& C) { return C.nonZeros() > 0 ? C.coeffs().abs().maxCoeff() : 0; }

}   // namespace

double asymmetry(const SparseMatrix& C) {
    const double largest = largest_entry(C);
    return largest > 0 ? largest_entry(C - SparseMatrix(C.transpose())) / largest : 0;
}

double row_sum_error(const SparseMatrix& C) { return (C * Vector::Ones(C.cols())).cwiseAbs().maxCoeff() / largest_entry(C); }

double energy_over_area(const TriangleMesh& mesh, const SparseMatrix& C) { return dirichlet_energy(C, mesh.X) / surface_area(mesh); }

double first_variation_error(const TriangleMesh& mesh, const SparseMatrix& C) {
    Positions gradient = Positions::Zero(mesh.X.rows(), 3);   // ∂(area)/∂x_i = ½ Σ n × e, e the edge opposite i, counter-clockwise
    const Positions normals = face_normals(mesh);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        const Vector3 normal = normals.row(t);
        for (int k = 0; k < 3; ++k) {
            const Vector3 opposite = mesh.X.row(mesh.F(t, (k + 2) % 3)) - mesh.X.row(mesh.F(t, (k + 1) % 3));
            gradient.row(mesh.F(t, k)) += 0.5 * normal.cross(opposite).transpose();
        }
    }
    double largest = 0;
    for (int j = 0; j < C.outerSize(); ++j) {
        Eigen::RowVector3d force = gradient.row(j);
        double size = 0;
        for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry) {   // a symmetric C: column j is row j
            const Eigen::RowVector3d edge = mesh.X.row(entry.row()) - mesh.X.row(j);
            force += entry.value() * edge;
            size += std::abs(entry.value()) * edge.norm();
        }
        if (size > 0) largest = std::max(largest, force.norm() / size);
    }
    return largest;
}

double mass_over_area(const TriangleMesh& mesh, const Vector& M) {
    Vector areas = face_areas(mesh);
    for (int t = 0; t < mesh.face_count(); ++t)
        if (kind_of(mesh, t) == TriangleKind::zero_area) areas[t] = 0;
    return M.sum() / areas.sum();
}

Inertia negative_eigenvalues(const SparseMatrix& C) {
    constexpr double sigma = -1e-10;   // so that zero eigenvalues count as positive
    const Vector diagonal = C.diagonal().cwiseAbs();
    const double largest = diagonal.maxCoeff();
    if (!(largest > 0)) return {sigma, 0, 0};
    const double unit = std::ldexp(1.0, std::ilogb(largest));   // a power of two: exact
    const Vector D = (diagonal.array() > 0).select(diagonal, largest) / unit;
    return inertia_at(-C / unit, D, sigma);
}

Proof semidefinite(const Inertia& negative) {
    if (!(negative.delta < -negative.sigma)) return Proof::undecided;
    return negative.below == 0 ? Proof::proved : Proof::refuted;
}

int repeated_half_edges(const Faces& F) {
    std::vector<std::uint64_t> half_edges;
    half_edges.reserve(static_cast<std::size_t>(3 * F.rows()));
    for (Eigen::Index t = 0; t < F.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            half_edges.push_back(static_cast<std::uint64_t>(F(t, k)) << 32 | static_cast<std::uint64_t>(F(t, (k + 1) % 3)));
    std::sort(half_edges.begin(), half_edges.end());
    int repeated = 0;
    for (std::size_t i = 1; i < half_edges.size(); ++i) repeated += half_edges[i] == half_edges[i - 1] ? 1 : 0;
    return repeated;
}

double flux_over_area(const TriangleMesh& mesh) {
    const Positions normals = face_normals(mesh);
    const Vector areas = face_areas(mesh);
    return (normals.transpose() * areas).norm() / areas.sum();
}

double total_deficit(const Vector& angle_deficits) {
    return static_cast<double>(std::accumulate(angle_deficits.begin(), angle_deficits.end(), 0.0L));
}

double gauss_bonnet_error(const Vector& angle_deficits, int euler_characteristic) {
    return std::abs(total_deficit(angle_deficits) / (2 * pi) - euler_characteristic);
}

double gauss_bonnet_tolerance(int triangles) { return 1e-12 + 1e-15 * triangles; }

}   // namespace meshfolio
