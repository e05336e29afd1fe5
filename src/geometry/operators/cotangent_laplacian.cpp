#include "geometry/operators/cotangent_laplacian.h"

#include "base/parallel.h"
#include "geometry/operators/intrinsic_delaunay.h"
#include "geometry/operators/triangle_shape.h"

namespace meshfolio {
namespace {

using Cotangent = double (TriangleShape::*)(std::size_t k) const;

/// Returns the m × 3 cotangents of triangles. @param shape_of  returns the shape of triangle t in any unit of length
template <class ShapeOf>
CornerValues cotangents_of(Eigen::Index triangles, ShapeOf shape_of, Cotangent cotangent = &TriangleShape::cotangent) {
    CornerValues cotangents(triangles, 3);
    for_each_index(static_cast<int>(triangles), [&](int t) {
        const TriangleShape triangle = shape_of(t);
        for (int k = 0; k < 3; ++k) cotangents(t, k) = (triangle.*cotangent)(static_cast<std::size_t>(k));
    });
    return cotangents;
}

CornerValues cotangents_of(const TriangleMesh& mesh, Cotangent cotangent) {
    const double scale = unit_scale(mesh);
    return cotangents_of(
        mesh.F.rows(), [&](int t) { return triangle_shape(mesh, t, scale); }, cotangent);
}

/// Returns the matrix with Σ value(t, k) over the corners opposite the edge from i to j, in the order of the triangles, at (i, j) and
/// (j, i); diagonal entries are stored.
template <class Value> SparseMatrix sum_at_opposite_edges(const Faces& F, int vertex_count, Value value) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(vertex_count + 6 * F.rows()));
    for (int v = 0; v < vertex_count; ++v) entries.emplace_back(v, v, 0);
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int i = F(t, (k + 1) % 3), j = F(t, (k + 2) % 3);
            if (i == j) continue;
            entries.emplace_back(i, j, value(t, k));
            entries.emplace_back(j, i, value(t, k));
        }
    }
    SparseMatrix sum(vertex_count, vertex_count);
    sum.setFromTriplets(entries.begin(), entries.end());
    return sum;
}

/// Sets C_jj = −Σ_i C_ij; every column stores its diagonal.
void set_diagonal(SparseMatrix& C) {
    for (Eigen::Index j = 0; j < C.cols(); ++j) {
        double sum = 0;
        for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry)
            if (entry.row() != j) sum += entry.value();
        C.coeffRef(j, j) = 0 - sum;
    }
}

}   // namespace

CornerValues corner_cotangents(const TriangleMesh& mesh) { return cotangents_of(mesh, &TriangleShape::cotangent); }

CornerValues corner_cotangents(const CornerValues& lengths) {
    require_lengths("corner_cotangents", lengths);
    return cotangents_of(lengths.rows(), [&](int t) {
        const double longest = lengths.row(t).maxCoeff();
        const double unit = longest > 0 ? longest : 1;
        return triangle_shape(lengths(t, 0) / unit, lengths(t, 1) / unit, lengths(t, 2) / unit);
    });
}

SparseMatrix cotangent_stiffness(const Faces& F, int vertex_count, const CornerValues& cotangents, const CotangentOptions& options) {
    require_corner_values("cotangent_stiffness", F, vertex_count, cotangents);
    SparseMatrix C = sum_at_opposite_edges(F, vertex_count, [&](Eigen::Index t, int k) { return 0.5 * cotangents(t, k); });
    if (options.opposite == CotangentOptions::OppositeVertices::mean)
        C.coeffs() /= sum_at_opposite_edges(F, vertex_count, [](Eigen::Index, int) { return 0.5; }).coeffs();
    if (options.clamp_negative) C.coeffs() = C.coeffs().max(0);
    set_diagonal(C);
    return C;
}

LaplaceBeltrami laplace_beltrami(const TriangleMesh& mesh, AreaForm area, const CotangentOptions& options) {
    return assembled_joined(mesh, [&](const TriangleMesh& joined) -> LaplaceBeltrami {
        return {cotangent_stiffness(joined.F, joined.vertex_count(), corner_cotangents(joined), options), vertex_areas(joined, area)};
    });
}

LaplaceBeltrami floored_laplace_beltrami(const TriangleMesh& mesh, AreaForm area) {
    return assembled_joined(mesh, [&](const TriangleMesh& joined) -> LaplaceBeltrami {
        const CornerValues cotangents = cotangents_of(joined, &TriangleShape::floored_cotangent);
        return {cotangent_stiffness(joined.F, joined.vertex_count(), cotangents), vertex_areas(joined, area)};
    });
}

LaplaceBeltrami laplace_beltrami(const Faces& F, int vertex_count, const CornerValues& lengths, AreaForm area,
                                 const CotangentOptions& options) {
    return {cotangent_stiffness(F, vertex_count, corner_cotangents(lengths), options), vertex_areas(F, vertex_count, lengths, area)};
}

SparseMatrix edge_normalised_laplacian(const TriangleMesh& mesh, bool clamp_negative) {
    SparseMatrix L = cotangent_stiffness(mesh.F, mesh.vertex_count(), corner_cotangents(mesh), {.clamp_negative = clamp_negative});
    const Vector A = vertex_areas(mesh, AreaForm::barycentric);
    for (Eigen::Index j = 0; j < L.cols(); ++j)
        for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
            const double areas = A[entry.row()] + A[j];
            entry.valueRef() = areas > 0 ? 2 * entry.value() / areas : 0;
        }
    set_diagonal(L);
    return L;
}

}   // namespace meshfolio
