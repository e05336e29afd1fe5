#include "mesh/samples/sample_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "mesh/edge_flips.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {

namespace {

/// Returns the mesh with coordinates rounded to six decimals: seven significant digits at the size of the samples, which lies between 1 and
/// 10.
TriangleMesh rounded(TriangleMesh mesh) {
    mesh.X = mesh.X.unaryExpr([](double x) { return std::round(x * 1e6) / 1e6 + 0.0; });   // + 0.0: no negative zero
    return mesh;
}

/// Returns the mesh with noise of sigma mean edges of the subdivided mesh, so that a finer mesh is not a smoother one.
TriangleMesh noisy(TriangleMesh mesh, const Vector3& sigma, std::uint64_t seed) {
    mesh.X = with_gaussian_noise(mesh.X, mean_edge_length(mesh) * sigma, seed);
    return mesh;
}

TriangleMesh subdivided(TriangleMesh mesh, int times) {
    for (int i = 0; i < times; ++i) mesh = subdivide_midpoint(mesh);
    return mesh;
}

// clang-format off
constexpr std::array samples{
    Sample{"cube", "cube of edge 1, each side 10 × 10 squares", [](int n) { return rounded(subdivided(cube_mesh(10), n)); }},
    Sample{"cube8", "cube of edge 1, 8 vertices and 12 triangles", [](int n) { return rounded(subdivided(cube_mesh(1), n)); }},
    Sample{"sphere", "unit sphere from an icosahedron", [](int n) { return rounded(icosphere(4 + n)); }},
    Sample{"ellipsoid", "ellipsoid with half axes 1.7, 1.1 and 0.6", [](int n) { return rounded(ellipsoid_mesh(4 + n, {1.7, 1.1, 0.6})); }},
    Sample{"torus", "torus about the z axis, radii 1 and 0.4", [](int n) { return rounded(torus_mesh(64 << n, 32 << n, 1, 0.4)); }},
    Sample{"bumpy_cube", "rounded cube whose sides carry one to six bumps, as a die", [](int n) { return rounded(bumpy_cube_sample(n)); }},
    Sample{"plane", "flat square of 10 × 10 points at distance 1, open", [](int n) { return rounded(subdivided(grid_mesh(10, 10, 9, 9), n)); }},
    Sample{"saddle", "z = (x² − y²)/2 over a square, open", [](int n) { return rounded(saddle_sample(n)); }},
    Sample{"lily", "flower of six curved petals, open", [](int n) { return rounded(lily_sample(n)); }},
    Sample{"creature", "small animal with limbs, ears, spines and a tail, waving", [](int n) { return rounded(creature_sample(n)); }},
    Sample{"plane_noisy", "irregular flat square with Gaussian noise of 0.1 (in the plane) and 0.25 (across) mean edges", [](int n) { return rounded(noisy(uneven_plane_sample(n), {0.1, 0.1, 0.25}, 1)); }},
    Sample{"fandisk_like", "machine part with straight and curved sharp edges", [](int n) { return rounded(fandisk_sample(n)); }},
    Sample{"fandisk_noisy", "fandisk_like with Gaussian noise of 0.2 mean edges", [](int n) { return rounded(noisy(fandisk_sample(n), {0.2, 0.2, 0.2}, 2)); }},
};
// clang-format on

}   // namespace

TriangleMesh subdivided_onto(TriangleMesh mesh, int times, const std::function<Vector3(const Vector3&)>& onto_surface) {
    for (int i = 0; i < times; ++i) {
        mesh = subdivide_midpoint(mesh);
        for (int v = 0; v < mesh.vertex_count(); ++v) mesh.X.row(v) = onto_surface(mesh.X.row(v));
    }
    return mesh;
}

TriangleMesh saddle_sample(int subdivide) {
    TriangleMesh mesh = grid_mesh(33, 33, 2, 2);
    const auto onto_saddle = [](const Vector3& p) { return Vector3(p.x(), p.y(), 0.5 * (p.x() * p.x() - p.y() * p.y())); };
    mesh.X.leftCols<2>().array() -= 1;
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.X.row(v) = onto_saddle(mesh.X.row(v));
    return subdivided_onto(mesh, subdivide, onto_saddle);
}

TriangleMesh uneven_plane_sample(int subdivide) {
    constexpr int points = 45;
    constexpr double spacing = 0.05, width = spacing * (points - 1), jitter = 0.25 * spacing;
    TriangleMesh mesh = grid_mesh(points, points, width, width);
    NormalNumbers random(45);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int axis = 0; axis < 2; ++axis) {
            const double step = jitter * (2 * random.uniform() - 1);
            const int place = axis == 0 ? v % points : v / points;
            if (place > 0 && place + 1 < points) mesh.X(v, axis) += step;   // the outline stays a square
        }
    }
    mesh.F = delaunay_flipped(mesh);
    return subdivided(mesh, subdivide);
}

std::span<const Sample> sample_list() { return samples; }

TriangleMesh make_sample(const std::string& name, int subdivide) {
    const auto sample = std::ranges::find(samples, name, &Sample::name);
    if (sample == samples.end()) {
        std::vector<std::string> known;
        for (const Sample& s : samples) known.emplace_back(s.name);
        throw UsageError("there is no sample \"" + printable(name) + "\"",
                         "did you mean \"" + nearest_word(name, known) + "\"? `meshfolio sample --list` names them all");
    }
    if (subdivide < 0 || subdivide > most_subdivisions)
        throw UsageError("a sample cannot be subdivided " + std::to_string(subdivide) + " times",
                         "give a number from 0 to " + std::to_string(most_subdivisions));
    return sample->make(subdivide);
}

}   // namespace meshfolio
