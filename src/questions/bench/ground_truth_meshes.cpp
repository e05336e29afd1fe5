#include "questions/bench/ground_truth_meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/curvature/test_surfaces.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/edge_flips.h"
#include "mesh/samples/random_sphere.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {

namespace {

constexpr int jitter_rounds = 4;        // with flips between them; more make the triangles little worse
constexpr double noise_amount = 0.01;   // of the mean edge

constexpr double cylinder_r = 1, cylinder_length = 4;
constexpr double catenoid_c = 1, catenoid_length = 3;
constexpr Saddle graph{1.2, 0.8};

/// The icosphere with its points drawn towards the equator plane: stretched there four to one.
TriangleMesh stretched_sphere(int level, const Vector3& half_axes) {
    TriangleMesh mesh = icosphere(level);
    mesh.X.col(2) *= 0.25;
    mesh.X.rowwise().normalize();
    mesh.X.array().rowwise() *= half_axes.transpose().array();
    return mesh;
}

Vector3 around_axis(double turns, double radius, double z) {
    return {radius * std::cos(2 * pi * turns), radius * std::sin(2 * pi * turns), z};
}

Vector3 radial(const Vector3& p) { return Vector3(p.x(), p.y(), 0).normalized(); }

/// The ellipsoid between 45° and 135° from its z axis, as a grid: regular everywhere, while the stretched icosphere is not at its twelve
/// vertices of valence 5, nor at those of the coarser levels, where the refinement by midpoints is not smooth.
TruthSurface ellipsoid_band(KnownSurface ellipsoid, const Vector3& axes) {
    const auto mesh = [axes](int around, int along) {
        return parameter_mesh(around, along + 1, true, [&](double s, double t) {
            const double v = pi * (0.75 - 0.5 * t);
            return Vector3(axes.cwiseProduct(around_axis(s, std::sin(v), std::cos(v))));
        });
    };
    ellipsoid.name = "ellipsoid band";
    ellipsoid.dimensions = curvature_words.line("dimensions.ellipsoid_band");
    ellipsoid.mesh_at = [=](int level) { return mesh(8 << level, 2 << level); };
    return {std::move(ellipsoid), [=](int level) { return mesh(4 << level, 4 << level); }};
}

TruthSurface cylinder() {
    const auto mesh = [](int around, int along) {
        return parameter_mesh(around, along + 1, true,
                              [](double s, double t) { return around_axis(s, cylinder_r, cylinder_length * (t - 0.5)); });
    };
    return {{"cylinder", curvature_words.line("dimensions.cylinder"), [=](int level) { return mesh(4 << level, 3 << level); },
             [](const Vector3& p) { return Vector3(cylinder_r * radial(p) + p.z() * Vector3::UnitZ()); }, radial,
             [](const Vector3&) { return cylinder_curvature(cylinder_r); }},
            [=](int level) { return mesh(2 << level, 6 << level); }};
}

TruthSurface catenoid() {
    const auto mesh = [](int around, int along) {
        return parameter_mesh(around, along + 1, true, [](double s, double t) {
            const double z = catenoid_length * (t - 0.5);
            return around_axis(s, catenoid_c * std::cosh(z / catenoid_c), z);
        });
    };
    return {{"catenoid", curvature_words.line("dimensions.catenoid"), [=](int level) { return mesh(4 << level, 2 << level); },
             [](const Vector3& p) { return Vector3(catenoid_c * std::cosh(p.z() / catenoid_c) * radial(p) + p.z() * Vector3::UnitZ()); },
             [](const Vector3& p) { return catenoid_normal(catenoid_c, p); },
             [](const Vector3& p) { return catenoid_curvature(catenoid_c, p); }},
            [=](int level) { return mesh(2 << level, 5 << level); }};
}

TruthSurface saddle() {
    const auto lifted = [](const Vector3& p) { return Vector3(p.x(), p.y(), graph.height(p.x(), p.y())); };
    const auto mesh = [=](int nx, int ny) {
        return parameter_mesh(nx + 1, ny + 1, false, [=](double s, double t) { return lifted({2 * s - 1, 2 * t - 1, 0}); });
    };
    return {{"saddle", curvature_words.line("dimensions.saddle"), [=](int level) { return mesh(4 << level, 4 << level); }, lifted,
             [](const Vector3& p) { return graph.normal_at(p); }, [](const Vector3& p) { return graph.curvature_at(p); }},
            [=](int level) { return mesh(8 << level, 2 << level); }};
}

int icosphere_vertices(int level) { return 10 * (1 << 2 * level) + 2; }

/// Independent points where their hull is the mesh.
TriangleMesh random_hull(const Vector3& half_axes, int points, std::uint64_t seed) {
    TriangleMesh mesh = random_sphere(points, seed);
    mesh.X.array().rowwise() *= half_axes.transpose().array();
    return mesh;
}

TriangleMesh wandered(const KnownSurface& surface, int level, std::uint64_t seed) {
    TriangleMesh mesh = surface.mesh_at(level);
    for (int round = 0; round < jitter_rounds; ++round) {
        mesh.X = jittered(mesh, topology_of(mesh), jitter_amount, seed + static_cast<std::uint64_t>(round), surface.projected);
        mesh.F = delaunay_flipped(mesh);
    }
    return mesh;
}

TriangleMesh mesh_of(const TruthSurface& s, MeshKind kind, int level, std::uint64_t seed) {
    if (kind == MeshKind::anisotropic) return s.stretched(level);
    if (kind != MeshKind::random) return s.surface.mesh_at(level);
    return s.half_axes.isZero() ? wandered(s.surface, level, seed) : random_hull(s.half_axes, icosphere_vertices(level), seed);
}

/// Whether no vertex of the boundary lies within so many edges.
std::vector<char> away_from_boundary(const MeshTopology& topology, int edges) {
    std::vector<char> near = topology.on_boundary;
    for (int ring = 0; ring < edges; ++ring) {
        const std::vector<char> before = near;
        for (const Edge& edge : topology.edges) {
            const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
            if (before[a] || before[b]) near[a] = near[b] = 1;
        }
    }
    for (char& flag : near) flag = flag ? 0 : 1;
    return near;
}

TruthMesh with_truth(TriangleMesh mesh, const KnownSurface& surface, int edges_from_boundary = 0) {
    TruthMesh t;
    t.mesh = std::move(mesh);
    t.topology = topology_of(t.mesh);
    t.mean_edge = mean_edge_length(t.mesh, t.topology.edges);
    const int n = t.mesh.vertex_count();
    t.normals.resize(n, 3);
    t.H.resize(n);
    t.K.resize(n);
    for (int i = 0; i < n; ++i) {
        const Vector3 p = t.mesh.X.row(i).transpose();
        const CurvaturePair truth = surface.curvature_at(p);
        t.normals.row(i) = surface.normal_at(p).transpose();
        t.H[i] = truth.H;
        t.K[i] = truth.K;
    }
    t.areas = vertex_areas(t.mesh, AreaForm::barycentric);
    t.measured = away_from_boundary(t.topology, edges_from_boundary);
    return t;
}

}   // namespace

std::string_view name_of(MeshKind kind) {
    constexpr std::array<std::string_view, 4> names{"regular", "random", "noisy", "anisotropic"};
    return names[static_cast<std::size_t>(kind)];
}

std::vector<TruthSurface> truth_surfaces() {
    std::vector<KnownSurface> known = known_surfaces();
    const Vector3 unit = Vector3::Ones();
    // The mesh of level 0 keeps the twelve points of the icosahedron: its extents are those of the ellipsoid times the same numbers.
    const Vector3 axes = bounding_box(known[1].mesh_at(0)).extent().cwiseQuotient(bounding_box(known[0].mesh_at(0)).extent());
    return {{known[0], [=](int level) { return stretched_sphere(level, unit); }, unit},
            {known[1], [=](int level) { return stretched_sphere(level, axes); }, axes},
            ellipsoid_band(known[1], axes),
            {known[2], [](int level) { return torus_mesh(2 << level, 4 << level, 1, 0.4); }},
            cylinder(),
            catenoid(),
            saddle()};
}

TruthMesh truth_mesh(const TruthSurface& s, MeshKind kind, int level, std::uint64_t seed) {
    // Three edges of level 2 at every level, so that errors of different levels are of the same part of the surface.
    const int edges_from_boundary = (3 << std::max(level - 2, 0)) - 1;
    TruthMesh t = with_truth(mesh_of(s, kind, level, seed), s.surface, edges_from_boundary);
    if (kind == MeshKind::noisy) {
        NormalNumbers random(seed);
        for (int i = 0; i < t.mesh.vertex_count(); ++i) t.mesh.X.row(i) += noise_amount * t.mean_edge * random.next() * t.normals.row(i);
        t.areas = vertex_areas(t.mesh, AreaForm::barycentric);
    }
    return t;
}

TruthMesh random_ellipsoid(const Vector3& half_axes, int points, std::uint64_t seed) {
    KnownSurface ellipsoid;
    ellipsoid.normal_at = [=](const Vector3& p) { return Vector3(p.cwiseQuotient(half_axes.cwiseAbs2()).normalized()); };
    ellipsoid.curvature_at = [=](const Vector3& p) { return ellipsoid_curvature(half_axes, p); };
    return with_truth(random_hull(half_axes, points, seed), ellipsoid);
}

}   // namespace meshfolio
