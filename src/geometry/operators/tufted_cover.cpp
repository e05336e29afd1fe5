#include "geometry/operators/tufted_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "base/at.h"
#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

/// A triangle at an edge, seen along the edge from its lower end to its higher one.
struct Blade {
    double angle;     // around the edge, from the first triangle on [rad]
    int ascending;    // the side of the copy that runs from low to high
    int descending;   // the side of the other copy
};

/// Returns the triangles at one edge in cyclic order. The first is at angle 0, so that its own rounding cannot move it to the end.
std::vector<Blade> blades_around(const TriangleMesh& mesh, std::span<const SideOfEdge> sides) {
    const int low = sides[0].low, high = sides[0].high;
    const auto direction = [&](int v) { return Vector3(mesh.X.row(v) - mesh.X.row(low)).stableNormalized(); };
    const auto arm_of = [&](const SideOfEdge& s) { return direction(mesh.F(s.side / 3, s.side % 3)); };
    const Vector3 axis = direction(high), start = arm_of(sides[0]);
    std::vector<Blade> blades;
    for (const SideOfEdge& s : sides) {
        const Vector3 arm = arm_of(s);
        double angle = std::atan2(axis.dot(start.cross(arm)), start.dot(arm) - start.dot(axis) * arm.dot(axis));
        if (blades.empty()) angle = 0;
        if (angle < 0) angle += 2 * pi;
        // Side k of the front is the side of the back at the corner with the same vertex: the back is (F0, F2, F1).
        const int back = 3 * (mesh.face_count() + s.side / 3) + (3 - s.side % 3) % 3;
        blades.push_back({angle, s.ascending ? s.side : back, s.ascending ? back : s.side});
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
    cover.glued_to.assign(6 * at(m), IntrinsicTriangles::not_glued);
    for_each_edge(mesh.F, [&](std::span<const SideOfEdge> sides) {
        const std::vector<Blade> blades = blades_around(mesh, sides);
        for (std::size_t b = 0; b < blades.size(); ++b) {
            // Counter-clockwise (low, high, tip) has its normal towards growing angles: it faces the next triangle.
            const int facing_next = blades[b].ascending, facing_back = blades[(b + 1) % blades.size()].descending;
            cover.glued_to[at(facing_next)] = facing_back;
            cover.glued_to[at(facing_back)] = facing_next;
        }
    });
    return cover;
}

IntrinsicTriangles tufted_cover(const TriangleMesh& mesh) {
    IntrinsicTriangles cover = two_sided_cover(mesh);
    mollify(cover.lengths, 1e-6);
    return intrinsic_delaunay(std::move(cover)).triangles;
}

LaplaceBeltrami tufted_laplacian(const TriangleMesh& mesh, AreaForm area) {
    const IntrinsicTriangles cover = tufted_cover(mesh);
    LaplaceBeltrami laplacian = laplace_beltrami(cover.F, cover.vertex_count, cover.lengths, area);
    laplacian.C *= 0.5;
    laplacian.M *= 0.5;
    return laplacian;
}

}   // namespace meshfolio
