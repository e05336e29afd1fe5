#include "questions/bench/bench_mesh.h"

#include "geometry/curvature/analytic_surfaces.h"
#include "geometry/curvature/curvature.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/edge_flips.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {

namespace {

constexpr double jitter_amount = 0.2;      // of the shortest edge: no ring stays regular, and no triangle turns over
constexpr int jitter_rounds = 4;           // with flips between them; more make the triangles little worse
constexpr double noise_amount = 0.01;      // of the mean edge
constexpr double negative_below = -1e-9;   // weights nearer to 0 are those of right angles, rounded

/// Returns the hull of random points on an ellipsoid: the images of uniform points on the sphere.
TriangleMesh random_hull(const Vector3& half_axes, int points, std::uint64_t seed) {
    TriangleMesh mesh = random_sphere(points, seed);
    mesh.X.array().rowwise() *= half_axes.transpose().array();
    return mesh;
}

TriangleMesh mesh_of(const KnownSurface& surface, MeshKind kind, int level, std::uint64_t seed) {
    if (kind == MeshKind::anisotropic) return surface.stretched_at(level);
    const bool is_random = kind == MeshKind::random;
    const int icosphere_vertices = 10 * (1 << 2 * level) + 2;
    if (is_random && !surface.half_axes.isZero()) return random_hull(surface.half_axes, icosphere_vertices, seed);
    TriangleMesh mesh = surface.mesh_at(level);
    const int rounds = is_random ? jitter_rounds : kind == MeshKind::jittered ? 1 : 0;
    for (int round = 0; round < rounds; ++round) {
        mesh.X = jittered(mesh, topology_of(mesh), jitter_amount, seed + static_cast<std::uint64_t>(round), surface.projected);
        if (is_random) mesh.F = delaunay_flipped(mesh);
    }
    return mesh;
}

BenchMesh with_truth(TriangleMesh mesh, const KnownSurface& surface, int edges_from_boundary = 0) {
    BenchMesh b;
    b.mesh = std::move(mesh);
    b.topology = topology_of(b.mesh);
    b.mean_edge = mean_edge_length(b.mesh, b.topology.edges);
    const int n = b.mesh.vertex_count();
    b.normals.resize(n, 3);
    b.H.resize(n);
    b.K.resize(n);
    for (int i = 0; i < n; ++i) {
        const Vector3 p = b.mesh.X.row(i).transpose();
        const CurvaturePair truth = surface.curvature_at(p);
        b.normals.row(i) = surface.normal_at(p).transpose();
        b.H[i] = truth.H;
        b.K[i] = truth.K;
    }
    b.areas = vertex_areas(b.mesh, AreaForm::barycentric);

    std::vector<char> near = b.topology.on_boundary;
    for (int ring = 0; ring < edges_from_boundary; ++ring) {
        const std::vector<char> before = near;
        for (const Edge& edge : b.topology.edges)
            if (before[edge.a] || before[edge.b]) near[edge.a] = near[edge.b] = 1;
    }
    for (const char flag : near) b.measured.push_back(flag ? 0 : 1);
    return b;
}

}   // namespace

std::string_view name_of(MeshKind kind) {
    constexpr std::array<std::string_view, 5> names{"regular", "jittered", "random", "noisy", "anisotropic"};
    return names[int(kind)];
}

const SparseMatrix& BenchMesh::C() const {
    return shared("C", [&] { return cotangent_stiffness(mesh.F, mesh.vertex_count(), corner_cotangents(mesh)); });
}

const Vector& BenchMesh::angle_deficits() const {
    return shared("angle deficits", [&] { return angle_deficit(mesh, topology); });
}

BenchMesh bench_mesh(const KnownSurface& surface, MeshKind kind, int level, std::uint64_t seed) {
    // Three edges of level 2 at every level, so that all levels measure the same part of the surface.
    const int edges_from_boundary = (3 << std::max(level - 2, 0)) - 1;
    BenchMesh b = with_truth(mesh_of(surface, kind, level, seed), surface, edges_from_boundary);
    if (kind == MeshKind::noisy) {
        NormalNumbers random(seed);
        for (int i = 0; i < b.mesh.vertex_count(); ++i) b.mesh.X.row(i) += noise_amount * b.mean_edge * random.next() * b.normals.row(i);
        b.areas = vertex_areas(b.mesh, AreaForm::barycentric);
    }
    return b;
}

BenchMesh random_ellipsoid(const Vector3& half_axes, int points, std::uint64_t seed) {
    return with_truth(random_hull(half_axes, points, seed), ellipsoid_surface(half_axes));
}

Positions jittered(const TriangleMesh& mesh, const MeshTopology& topology, double amount, std::uint64_t seed,
                   const std::function<Vector3(const Vector3&)>& projected) {
    Vector shortest = Vector::Constant(mesh.vertex_count(), infinity);   // edge at each vertex
    for (const Edge& edge : topology.edges) {
        const double length = (mesh.X.row(edge.a) - mesh.X.row(edge.b)).norm();
        for (const int v : {edge.a, edge.b}) shortest[v] = std::min(shortest[v], length);
    }
    NormalNumbers random(seed);
    Positions X = mesh.X;
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        Vector3 step;
        for (double& s : step) s = amount * shortest[i] * (2 * random.uniform() - 1);
        if (!topology.on_boundary[i] && std::isfinite(shortest[i])) X.row(i) = projected(X.row(i).transpose() + step);
    }
    return X;
}

NegativeWeights negative_weights(const SparseMatrix& C, const MeshTopology& topology) {
    NegativeWeights found;
    for (const Edge& edge : topology.edges) {
        const double weight = C.coeff(edge.a, edge.b);
        found.smallest = std::min(found.smallest, weight);
        if (weight < negative_below) ++(edge.faces == 1 ? found.boundary : found.inside);
    }
    return found;
}

}   // namespace meshfolio
