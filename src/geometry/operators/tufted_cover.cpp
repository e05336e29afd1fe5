#include "geometry/operators/tufted_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// A triangle at an edge, seen along the edge from its lower end to its higher one.
struct Blade {
    double angle;    // around the edge, from the first triangle on [rad]
    int ascending;   // the side of the copy that runs from low to high
    int descending;
};

/// Side k of the front is the side of the back at the corner with the same vertex: the back is (F0, F2, F1).
int other_face_of(int side, int triangles) { return 3 * (triangles + side / 3) + (3 - side % 3) % 3; }

double angle_around(const TriangleMesh& mesh, const SideOfEdge& edge, const Vector3& start) {
    const Vector3 low = mesh.X.row(edge.low), axis = (mesh.X.row(edge.high).transpose() - low).stableNormalized();
    const Vector3 arm = (mesh.X.row(mesh.F(edge.side / 3, edge.side % 3)).transpose() - low).stableNormalized();
    return std::atan2(axis.dot(start.cross(arm)), start.dot(arm) - start.dot(axis) * arm.dot(axis));
}

/// The triangles at one edge in cyclic order. The first is at angle 0, so that its own rounding cannot move it to the end.
std::vector<Blade> blades_around(const TriangleMesh& mesh, std::vector<SideOfEdge>::const_iterator first,
                                 std::vector<SideOfEdge>::const_iterator last) {
    const Vector3 low = mesh.X.row(first->low);
    const Vector3 start = (mesh.X.row(mesh.F(first->side / 3, first->side % 3)).transpose() - low).stableNormalized();
    std::vector<Blade> blades;
    for (auto s = first; s != last; ++s) {
        const int back = other_face_of(s->side, mesh.face_count());
        blades.push_back({s == first ? 0 : angle_around(mesh, *s, start), s->ascending ? s->side : back, s->ascending ? back : s->side});
        if (blades.back().angle < 0) blades.back().angle += 2 * pi;
    }
    std::stable_sort(blades.begin(), blades.end(), [](const Blade& a, const Blade& b) { return a.angle < b.angle; });
    return blades;
}

}   // namespace

double mollify(CornerValues& lengths, double relative) {
    if (lengths.rows() == 0) return 0;
    const double margin = relative * lengths.mean();
    double added = 0;
    for (Eigen::Index t = 0; t < lengths.rows(); ++t) {
        const double longest = lengths.row(t).maxCoeff();
        added = std::max(added, margin - (lengths.row(t).sum() - longest - longest));
    }
    if (added > 0) lengths.array() += added;
    return added;
}

IntrinsicTriangles two_sided_cover(const TriangleMesh& mesh) {
    const int m = mesh.face_count();
    const CornerValues lengths = edge_lengths(mesh);
    IntrinsicTriangles cover{Faces(2 * m, 3), CornerValues(2 * m, 3), {}, mesh.vertex_count()};
    cover.F << mesh.F, mesh.F(Eigen::all, {0, 2, 1});
    cover.lengths << lengths, lengths(Eigen::all, {0, 2, 1});
    cover.glued_to.assign(6 * static_cast<std::size_t>(m), IntrinsicTriangles::not_glued);
    const std::vector<SideOfEdge> sides = sides_by_edge(mesh.F);
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last =
            std::find_if_not(first, sides.end(), [&](const SideOfEdge& s) { return s.low == first->low && s.high == first->high; });
        const std::vector<Blade> blades = blades_around(mesh, first, last);
        for (std::size_t b = 0; b < blades.size(); ++b) {
            // Counter-clockwise (low, high, tip) has its normal towards growing angles: it faces the next triangle.
            const int facing_next = blades[b].ascending, facing_back = blades[(b + 1) % blades.size()].descending;
            cover.glued_to[static_cast<std::size_t>(facing_next)] = facing_back;
            cover.glued_to[static_cast<std::size_t>(facing_back)] = facing_next;
        }
        first = last;
    }
    return cover;
}

TuftedCover tufted_cover(const TriangleMesh& mesh, double mollification) {
    TuftedCover tufted;
    IntrinsicTriangles cover = two_sided_cover(mesh);
    tufted.added_length = mollify(cover.lengths, mollification);
    tufted.delaunay = intrinsic_delaunay(std::move(cover));
    return tufted;
}

LaplaceBeltrami tufted_laplacian(const TriangleMesh& mesh, AreaForm area) {
    const IntrinsicTriangles cover = tufted_cover(mesh).delaunay.triangles;
    LaplaceBeltrami laplacian = laplace_beltrami(cover.F, cover.vertex_count, cover.lengths, area);
    laplacian.C *= 0.5;
    laplacian.M *= 0.5;
    return laplacian;
}

}   // namespace meshfolio
