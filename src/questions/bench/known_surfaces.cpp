#include "questions/bench/known_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/measures/mesh_error.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {

namespace {

constexpr double torus_R = 1, torus_r = 0.4;

KnownSurface known_sphere() {
    const auto radial = [](const Vector3& p) { return Vector3(p.normalized()); };
    return {"sphere", curvature_words.line("dimensions.sphere"),         [](int level) { return icosphere(level); }, radial,
            radial,   [](const Vector3&) { return sphere_curvature(1); }};
}

KnownSurface known_ellipsoid() {
    const Vector3 axes(1.5, 1.0, 0.75);
    return {"ellipsoid",
            curvature_words.line("dimensions.ellipsoid"),
            [axes](int level) { return ellipsoid_mesh(level, axes); },
            [axes](const Vector3& p) { return Vector3(p / p.cwiseQuotient(axes).norm()); },
            [axes](const Vector3& p) { return Vector3(p.cwiseQuotient(axes.cwiseAbs2()).normalized()); },
            [axes](const Vector3& p) { return ellipsoid_curvature(axes, p); }};
}

KnownSurface known_torus() {
    const auto tube_centre = [](const Vector3& p) { return Vector3(torus_R * Vector3(p.x(), p.y(), 0).normalized()); };
    return {"torus",
            curvature_words.line("dimensions.torus"),
            [](int level) { return torus_mesh(4 << level, 2 << level, torus_R, torus_r); },
            [=](const Vector3& p) { return Vector3(tube_centre(p) + torus_r * (p - tube_centre(p)).normalized()); },
            [=](const Vector3& p) { return Vector3((p - tube_centre(p)).normalized()); },
            [](const Vector3& p) { return torus_curvature(torus_R, torus_r, p); }};
}

/// n lengths of the shortest edge at each vertex; 0 at unreferenced ones.
Vector shortest_edges(const TriangleMesh& mesh, const MeshTopology& topology) {
    Vector shortest = Vector::Constant(mesh.vertex_count(), std::numeric_limits<double>::infinity());
    for (const Edge& edge : topology.edges) {
        const double length = (mesh.X.row(edge.a) - mesh.X.row(edge.b)).norm();
        for (const int v : {edge.a, edge.b}) shortest[v] = std::min(shortest[v], length);
    }
    return shortest.array().isFinite().select(shortest, 0);
}

}   // namespace

std::vector<KnownSurface> known_surfaces() { return {known_sphere(), known_ellipsoid(), known_torus()}; }

Positions jittered(const TriangleMesh& mesh, const MeshTopology& topology, double amount, std::uint64_t seed,
                   const std::function<Vector3(const Vector3&)>& projected) {
    const Vector edge = shortest_edges(mesh, topology);
    NormalNumbers random(seed);
    Positions X = mesh.X;
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        Vector3 step;
        for (double& s : step) s = amount * edge[i] * (2 * random.uniform() - 1);
        if (!topology.on_boundary[static_cast<std::size_t>(i)]) X.row(i) = projected(X.row(i).transpose() + step);
    }
    return X;
}

SampledSurface sampled(const KnownSurface& surface, int level, Triangulation triangulation, std::uint64_t seed) {
    SampledSurface s;
    s.mesh = surface.mesh_at(level);
    s.topology = topology_of(s.mesh);
    if (triangulation == Triangulation::jittered) s.mesh.X = jittered(s.mesh, s.topology, jitter_amount, seed, surface.projected);
    const int n = s.mesh.vertex_count();
    s.normals.resize(n, 3);
    s.H.resize(n);
    s.K.resize(n);
    for (int i = 0; i < n; ++i) {
        const CurvaturePair truth = surface.curvature_at(s.mesh.X.row(i));
        s.normals.row(i) = surface.normal_at(s.mesh.X.row(i)).transpose();
        s.H[i] = truth.H;
        s.K[i] = truth.K;
    }
    s.areas = vertex_areas(s.mesh, AreaForm::barycentric);
    s.mean_edge = mean_edge_length(s.mesh);
    s.smallest_angle = smallest_angle(s.mesh);
    return s;
}

std::vector<int> refinement_levels(bool quick) { return quick ? std::vector{3, 4, 5} : std::vector{2, 3, 4, 5, 6}; }

double fitted_order(const std::vector<double>& mean_edges, const std::vector<double>& errors) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = errors.size() > 3 ? errors.size() - 3 : 0; i < errors.size(); ++i) {
        if (!(errors[i] > 0) || !std::isfinite(errors[i])) continue;
        const double x = std::log(mean_edges[i]), y = std::log(errors[i]);
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return n < 2 ? std::nan("") : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}   // namespace meshfolio
