#include "geometry/operators/vertex_areas.h"

#include <array>

#include "base/at.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/operators/intrinsic_delaunay.h"
#include "geometry/operators/triangle_shape.h"

namespace meshfolio {
namespace {

constexpr std::array<std::string_view, 3> form_names{"barycentric", "voronoi", "mixed"};

using CornerAreas = std::array<double, 3>;

/// Returns the area that each corner of a triangle gets.
CornerAreas corner_areas(const TriangleShape& triangle, AreaForm form) {
    CornerAreas shares;
    shares.fill(triangle.area() / 3);
    if (form == AreaForm::barycentric) return shares;
    for (std::size_t k = 0; k < 3 && form == AreaForm::mixed; ++k) {
        if (triangle.dot[k] >= 0) continue;   // Meyer et al. 2003, figure 4, for an obtuse corner
        shares.fill(triangle.area() / 4);
        shares[k] = triangle.area() / 2;
        return shares;
    }
    CornerAreas edge_part;   // Voronoi: corner i of edges e_j, e_k has (cot θ_j |e_j|² + cot θ_k |e_k|²)/8
    for (std::size_t k = 0; k < 3; ++k) edge_part[k] = triangle.cotangent(k) * triangle.squared_edge[k] / 8;
    return {edge_part[1] + edge_part[2], edge_part[2] + edge_part[0], edge_part[0] + edge_part[1]};
}

/// Returns n areas, summed over the triangles in their order. @param shape_of  triangle t in a unit with squared length `unit_area`
template <class ShapeOf>
Vector sum_of_shares(const Faces& F, Eigen::Index vertex_count, AreaForm form, ShapeOf shape_of, double unit_area) {
    Vector areas = Vector::Zero(vertex_count);
    in_order(
        static_cast<int>(F.rows()), [&](int t) { return corner_areas(shape_of(t), form); },
        [&](int t, const CornerAreas& share) {
            for (int k = 0; k < 3; ++k) areas[F(t, k)] += share[at(k)];
        });
    return areas * unit_area;
}

}   // namespace

std::string_view name_of(AreaForm form) { return form_names[static_cast<std::size_t>(form)]; }

AreaForm area_form_named(const std::string& name) {
    const auto found = std::ranges::find(form_names, name);
    if (found != form_names.end()) return static_cast<AreaForm>(found - form_names.begin());
    throw UsageError("unknown form of area '" + printable(name) + "'", "use barycentric, voronoi or mixed");
}

Vector vertex_areas(const TriangleMesh& mesh, AreaForm form) {
    const double scale = unit_scale(mesh);
    const auto shape_of = [&](int t) { return triangle_shape(mesh, t, scale); };
    return sum_of_shares(mesh.F, mesh.X.rows(), form, shape_of, 1 / (scale * scale));
}

Vector vertex_areas(const Faces& F, int vertex_count, const CornerValues& lengths, AreaForm form) {
    require_corner_values("vertex_areas", F, vertex_count, lengths);
    require_lengths("vertex_areas", lengths);
    const double longest = lengths.rows() > 0 ? lengths.maxCoeff() : 0;
    const double unit = longest > 0 ? longest : 1;
    const auto shape_of = [&](int t) { return triangle_shape(lengths(t, 0) / unit, lengths(t, 1) / unit, lengths(t, 2) / unit); };
    return sum_of_shares(F, vertex_count, form, shape_of, unit * unit);
}

}   // namespace meshfolio
