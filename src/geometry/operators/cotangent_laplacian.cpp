#include "geometry/operators/cotangent_laplacian.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/operators/intrinsic_triangles.h"
#include "geometry/operators/triangle_shape.h"
#include "mesh/prefetch.h"

namespace meshfolio {
namespace {

/// The weight C_ij of an edge from the sum of its opposite cotangents and their number.
double edge_weight(double cotangent_sum, std::ptrdiff_t opposite_corners, const CotangentOptions& options) {
    const bool mean = options.opposite == CotangentOptions::OppositeVertices::mean;
    const double weight = mean ? cotangent_sum / static_cast<double>(opposite_corners) : 0.5 * cotangent_sum;
    return options.clamp_negative ? std::max(weight, 0.0) : weight;
}

/// An edge seen from its smaller end: the other end, and the cotangent of an opposite corner, later the weight of the edge.
struct Spoke {
    int other;
    double value;
};

/// The spokes of every vertex, one vertex after the other; those of vertex v begin at start[v].
struct Spokes {
    std::vector<std::size_t> start;   // n + 1
    std::vector<Spoke> spoke;
};

/// Calls visit(smaller end, larger end, opposite cotangent) for every edge of every triangle, in the order of the triangles.
template <class Visit>
void for_each_triangle_edge(const Faces& F, const CornerValues& cotangents, Visit visit) {
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax({F(t, (k + 1) % 3), F(t, (k + 2) % 3)});
            if (a != b) visit(static_cast<std::size_t>(a), b, cotangents(t, k));
        }
    }
}

/// One spoke for each opposite corner, grouped by smaller end by counting.
Spokes opposite_corners_by_edge_end(const Faces& F, int vertex_count, const CornerValues& cotangents) {
    Spokes spokes;
    spokes.start.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
    for_each_triangle_edge(F, cotangents, [&](std::size_t a, int, double) { ++spokes.start[a + 1]; });
    for (std::size_t v = 1; v < spokes.start.size(); ++v) spokes.start[v] += spokes.start[v - 1];
    spokes.spoke.resize(spokes.start.back());
    std::vector<std::size_t> next(spokes.start.begin(), spokes.start.end() - 1);
    for_each_triangle_edge(F, cotangents, [&](std::size_t a, int b, double cotangent) { spokes.spoke[next[a]++] = {b, cotangent}; });
    return spokes;
}

/// Stable, so that the cotangents of an edge are added in the order of the triangles. One-rings are short: insertion sort.
void sort_by_other_end(Spoke* first, Spoke* last) {
    const auto before = [](const Spoke& s, const Spoke& t) { return s.other < t.other; };
    if (last - first > 64) return std::stable_sort(first, last, before);
    for (Spoke* s = first; s != last; ++s) {
        const Spoke moving = *s;
        Spoke* hole = s;
        for (; hole != first && before(moving, hole[-1]); --hole) *hole = hole[-1];
        *hole = moving;
    }
}

/// From one spoke a corner to one spoke an edge, its value the weight; the other ends ascend.
void merge_corners_into_edges(Spokes& spokes, const CotangentOptions& options) {
    std::size_t kept = 0;
    for (std::size_t v = 0; v + 1 < spokes.start.size(); ++v) {
        Spoke* const first = spokes.spoke.data() + spokes.start[v];
        Spoke* const last = spokes.spoke.data() + spokes.start[v + 1];
        sort_by_other_end(first, last);
        spokes.start[v] = kept;
        for (const Spoke* run = first; run != last;) {
            const Spoke* end = run;
            double sum = 0;
            for (; end != last && end->other == run->other; ++end) sum += end->value;
            spokes.spoke[kept++] = {run->other, edge_weight(sum, end - run, options)};
            run = end;
        }
    }
    spokes.start.back() = kept;
    spokes.spoke.resize(kept);
}

/// First entry of each column: the edges at the vertex and the diagonal.
void count_columns(const Spokes& edges, int* outer) {
    const std::size_t n = edges.start.size() - 1;
    std::fill(outer, outer + n + 1, 0);
    for (std::size_t v = 0; v < n; ++v) outer[v + 1] += 1 + static_cast<int>(edges.start[v + 1] - edges.start[v]);
    for (const Spoke& edge : edges.spoke) ++outer[edge.other + 1];
    for (std::size_t v = 0; v < n; ++v) outer[v + 1] += outer[v];
}

/// Going through the vertices in order leaves every column sorted: when v is reached, its column holds the edges to
/// smaller vertices; the diagonal follows, then the edges to larger ones.
void fill_columns(const Spokes& edges, SparseMatrix& C) {
    const std::size_t n = edges.start.size() - 1;
    std::vector<int> next(C.outerIndexPtr(), C.outerIndexPtr() + n);
    const auto append = [&](std::size_t column, int row, double value) {
        const int place = next[column]++;
        C.innerIndexPtr()[place] = row;
        C.valuePtr()[place] = value;
    };
    for (std::size_t v = 0; v < n; ++v) {
        double sum = 0;
        for (int place = C.outerIndexPtr()[v]; place < next[v]; ++place) sum += C.valuePtr()[place];
        for (std::size_t s = edges.start[v]; s < edges.start[v + 1]; ++s) sum += edges.spoke[s].value;
        append(v, static_cast<int>(v), 0 - sum);
        for (std::size_t s = edges.start[v]; s < edges.start[v + 1]; ++s) {
            const Spoke& edge = edges.spoke[s];
            append(v, edge.other, edge.value);
            append(static_cast<std::size_t>(edge.other), static_cast<int>(v), edge.value);
        }
    }
}

using Cotangent = double (TriangleShape::*)(std::size_t k) const;

/// Cotangents of triangles given by `shape_of(t)`, and how many have no area. @param areas  of the triangles, if asked for
template <class ShapeOf>
CornerValues cotangents_of_shapes(Eigen::Index triangles, ShapeOf shape_of, int* without_area,
                                  Cotangent cotangent = &TriangleShape::cotangent, Vector* areas = nullptr) {
    CornerValues cotangents(triangles, 3);
    const auto degenerate_of_blocks = of_blocks(static_cast<int>(triangles), [&](int begin, int end) {
        int count = 0;
        for (int t = begin; t < end; ++t) {
            const TriangleShape triangle = shape_of(t);
            for (int k = 0; k < 3; ++k) cotangents(t, k) = (triangle.*cotangent)(static_cast<std::size_t>(k));
            if (areas != nullptr) (*areas)[t] = triangle.area();
            count += triangle.degenerate() ? 1 : 0;
        }
        return count;
    });
    if (without_area == nullptr) return cotangents;
    *without_area = 0;
    for (const auto& block : degenerate_of_blocks) *without_area += block.value;
    return cotangents;
}

/// A third of each triangle around. @param areas  of the triangles, in units of which `unit_area` is one [length²]
Vector barycentric_areas(const TriangleMesh& mesh, const Vector& areas, double unit_area) {
    Vector sums = Vector::Zero(mesh.vertex_count());
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t)
        for (const int v : mesh.F.row(t)) sums[v] += areas[t] / 3;
    return sums * unit_area;
}

/// Each triangle is measured once where its areas are not those of Voronoi cells.
LaplaceBeltrami laplacian_of(const TriangleMesh& mesh, AreaForm form, Cotangent cotangent, const CotangentOptions& options) {
    const double scale = unit_scale(mesh);
    const auto shape_of = [&](int t) {
        prefetch_corners(mesh, t);
        return triangle_shape(mesh, t, scale);
    };
    const bool barycentric = form == AreaForm::barycentric;
    Vector areas(barycentric ? mesh.F.rows() : 0);
    const CornerValues cotangents = cotangents_of_shapes(mesh.F.rows(), shape_of, nullptr, cotangent, barycentric ? &areas : nullptr);
    return {cotangent_stiffness(mesh.F, mesh.vertex_count(), cotangents, options),
            barycentric ? barycentric_areas(mesh, areas, 1 / (scale * scale)) : vertex_areas(mesh, form)};
}

}   // namespace

CornerValues corner_cotangents(const TriangleMesh& mesh, int* without_area) {
    const double scale = unit_scale(mesh);
    const auto shape_of = [&](int t) {
        prefetch_corners(mesh, t);
        return triangle_shape(mesh, t, scale);
    };
    return cotangents_of_shapes(mesh.F.rows(), shape_of, without_area);
}

CornerValues corner_cotangents(const CornerValues& lengths, int* without_area) {
    require_lengths("corner_cotangents", lengths);
    const auto shape_of = [&](int t) {
        const double longest = lengths.row(t).maxCoeff();
        const double unit = longest > 0 ? longest : 1;
        return triangle_shape(lengths(t, 0) / unit, lengths(t, 1) / unit, lengths(t, 2) / unit);
    };
    return cotangents_of_shapes(lengths.rows(), shape_of, without_area);
}

SparseMatrix cotangent_stiffness(const Faces& F, int vertex_count, const CornerValues& cotangents, const CotangentOptions& options) {
    require_corner_values("cotangent_stiffness", F, vertex_count, cotangents);
    Spokes edges = opposite_corners_by_edge_end(F, vertex_count, cotangents);
    merge_corners_into_edges(edges, options);
    SparseMatrix C(vertex_count, vertex_count);
    count_columns(edges, C.outerIndexPtr());
    C.resizeNonZeros(C.outerIndexPtr()[vertex_count]);
    fill_columns(edges, C);
    return C;
}

LaplaceBeltrami laplace_beltrami(const TriangleMesh& mesh, AreaForm area, const CotangentOptions& options) {
    return assembled_joined(mesh,
                            [&](const TriangleMesh& joined) { return laplacian_of(joined, area, &TriangleShape::cotangent, options); });
}

LaplaceBeltrami floored_laplace_beltrami(const TriangleMesh& mesh, AreaForm area) {
    return assembled_joined(mesh,
                            [&](const TriangleMesh& joined) { return laplacian_of(joined, area, &TriangleShape::floored_cotangent, {}); });
}

LaplaceBeltrami laplace_beltrami(const Faces& F, int vertex_count, const CornerValues& lengths, AreaForm area,
                                 const CotangentOptions& options) {
    return {cotangent_stiffness(F, vertex_count, corner_cotangents(lengths), options), vertex_areas(F, vertex_count, lengths, area)};
}

SparseMatrix edge_normalised_laplacian(const TriangleMesh& mesh, bool clamp_negative) {
    SparseMatrix L = cotangent_stiffness(mesh.F, mesh.vertex_count(), corner_cotangents(mesh), {.clamp_negative = clamp_negative});
    const Vector A = vertex_areas(mesh, AreaForm::barycentric);
    for (Eigen::Index j = 0; j < L.outerSize(); ++j) {
        double sum = 0;
        for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
            if (entry.row() == j) continue;
            const double areas = A[entry.row()] + A[j];
            entry.valueRef() = areas > 0 ? 2 * entry.value() / areas : 0;
            sum += entry.value();
        }
        L.coeffRef(j, j) = 0 - sum;   // every column has its diagonal
    }
    return L;
}

}   // namespace meshfolio
