#include "geometry/denoising/normal_filters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

/// Returns Φ, the largest difference between two normals of the patch. Triangles without a normal do not count.
double largest_difference(const Positions& N, const int* begin, const int* end) {
    double largest = 0;
    for (const int* s = begin; s != end; ++s) {
        if (N.row(*s).isZero(0)) continue;
        for (const int* r = s + 1; r != end; ++r)
            if (!N.row(*r).isZero(0)) largest = std::max(largest, (N.row(*s) - N.row(*r)).squaredNorm());
    }
    return std::sqrt(largest);
}

/// Returns R, the largest saliency of an inner edge of the patch over the sum of all.
double edge_concentration(const Positions& N, const Incidence& by_edge, const int* begin, const int* end) {
    double largest = 0, sum = 0;
    for (const int* s = begin; s != end; ++s) {
        for (const int* r = by_edge.begin(*s); r != by_edge.end(*s); ++r) {
            if (*r <= *s || !std::binary_search(begin, end, *r)) continue;
            const double saliency = (N.row(*s) - N.row(*r)).norm();
            largest = std::max(largest, saliency);
            sum += saliency;
        }
    }
    constexpr double negligible = 1e-9;   // a flat patch has no edge to speak of
    return largest / (negligible + sum);
}

}   // namespace

FaceRings face_rings(const TriangleMesh& mesh) {
    const Incidence around = triangles_around(mesh);
    FaceRings rings;
    rings.by_vertex.start = rings.by_edge.start = {0};
    std::vector<int> ring;
    for (int t = 0; t < mesh.face_count(); ++t) {
        ring.clear();
        for (const int v : mesh.F.row(t)) ring.insert(ring.end(), around.begin(v), around.end(v));
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        for (const int s : ring) {
            rings.by_vertex.item.push_back(s);
            int shared = 0;
            for (const int v : mesh.F.row(s)) shared += (mesh.F.row(t).array() == v).any() ? 1 : 0;
            if (s != t && shared >= 2) rings.by_edge.item.push_back(s);
        }
        for (Incidence* row : {&rings.by_vertex, &rings.by_edge}) row->start.push_back(static_cast<int>(row->item.size()));
    }
    return rings;
}

Positions face_centroids(const TriangleMesh& mesh) {
    Positions centroids(mesh.face_count(), 3);
    for (int t = 0; t < mesh.face_count(); ++t)
        centroids.row(t) = (mesh.X.row(mesh.F(t, 0)) + mesh.X.row(mesh.F(t, 1)) + mesh.X.row(mesh.F(t, 2))) / 3;
    return centroids;
}

NormalKernel normal_kernel(const TriangleMesh& mesh) { return normal_kernel(mesh, face_rings(mesh)); }

NormalKernel normal_kernel(const TriangleMesh& mesh, FaceRings rings) {
    const Positions centroids = face_centroids(mesh);
    const Vector areas = face_areas(mesh);
    double sigma = 0;   // mean distance of neighbours over an edge
    for (int t = 0; t < mesh.face_count(); ++t)
        for (const int* s = rings.by_edge.begin(t); s != rings.by_edge.end(t); ++s) sigma += (centroids.row(*s) - centroids.row(t)).norm();
    if (!rings.by_edge.item.empty()) sigma /= static_cast<double>(rings.by_edge.item.size());
    NormalKernel kernel{std::move(rings), {}};
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (const int* s = kernel.rings.by_vertex.begin(t); s != kernel.rings.by_vertex.end(t); ++s) {
            const double near = sigma > 0 ? (centroids.row(*s) - centroids.row(t)).norm() / sigma : 0;
            kernel.weights.push_back(areas[*s] * std::exp(-0.5 * near * near));
        }
    }
    return kernel;
}

Positions filtered_normals(const NormalKernel& kernel, const Positions& N, const Positions& guide, double sigma_r) {
    if (!(sigma_r > 0)) throw MeshError("normal filter: sigma_r = " + plain_text(sigma_r), "it must be positive");
    const Incidence& ring = kernel.rings.by_vertex;
    const double per_square = -0.5 / (sigma_r * sigma_r);
    Positions filtered = N;
    for (int t = 0; t < static_cast<int>(N.rows()); ++t) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int i = ring.start[at(t)]; i < ring.start[at(t) + 1]; ++i) {
            const int s = ring.item[at(i)];
            const double range = std::exp(per_square * (guide.row(s) - guide.row(t)).squaredNorm());
            sum += kernel.weights[at(i)] * range * N.row(s);
        }
        if (const double length = sum.norm(); length > 0) filtered.row(t) = sum / length;
    }
    return filtered;
}

Positions guiding_normals(const TriangleMesh& mesh, const FaceRings& rings, const Positions& N) {
    const Vector areas = face_areas(mesh);
    Positions mean = Positions::Zero(N.rows(), 3);   // of the patch around each triangle, unit
    Vector inconsistency(N.rows());                  // H = Φ R of that patch
    for (int t = 0; t < static_cast<int>(N.rows()); ++t) {
        const int *begin = rings.by_vertex.begin(t), *end = rings.by_vertex.end(t);
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (const int* s = begin; s != end; ++s) sum += areas[*s] * N.row(*s);
        if (const double length = sum.norm(); length > 0) mean.row(t) = sum / length;
        inconsistency[t] = largest_difference(N, begin, end) * edge_concentration(N, rings.by_edge, begin, end);
    }
    Positions guide(N.rows(), 3);
    for (int t = 0; t < static_cast<int>(N.rows()); ++t) {
        // The patches that contain t are those of the triangles around it, its own first: where none is better, nothing is shifted.
        int best = t;
        for (const int* s = rings.by_vertex.begin(t); s != rings.by_vertex.end(t); ++s)
            if (inconsistency[*s] < inconsistency[best] && !mean.row(*s).isZero(0)) best = *s;
        guide.row(t) = mean.row(best);
    }
    return guide;
}

Positions moved_to_normals(const TriangleMesh& mesh, const Incidence& vertex_faces, const Positions& N, int sweeps) {
    TriangleMesh moved = mesh;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        const Positions centroids = face_centroids(moved);
        for (int v = 0; v < moved.vertex_count(); ++v) {
            const Eigen::RowVector3d x = moved.X.row(v);
            Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
            for (const int* t = vertex_faces.begin(v); t != vertex_faces.end(v); ++t)
                sum += N.row(*t).dot(centroids.row(*t) - x) * N.row(*t);
            if (vertex_faces.size(v) > 0) moved.X.row(v) = x + sum / vertex_faces.size(v);
        }
    }
    return moved.X;
}

}   // namespace meshfolio
