/// @file
/// Surfaces whose curvature is known in closed form, meshed finer and finer: what curvature estimates are measured on.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geometry/curvature/analytic_surfaces.h"
#include "mesh/mesh_topology.h"
#include "report/words.h"

namespace meshfolio {

/// What the questions on curvature share.
inline constexpr report::Words curvature_words("curvature");

struct KnownSurface {
    std::string name;                                            // "torus"
    std::string dimensions;                                      // "R = 1, r = 0.4"
    std::function<TriangleMesh(int level)> mesh_at;              // each level halves the edges; vertices lie on the surface
    std::function<Vector3(const Vector3&)> projected;            // a nearby point onto the surface
    std::function<Vector3(const Vector3&)> normal_at;            // unit, outward, at a point of the surface
    std::function<CurvaturePair(const Vector3&)> curvature_at;   // at a point of the surface
};

/// Sphere (icosphere), ellipsoid (the same, stretched) and torus (a grid whose squares are cut along one diagonal).
std::vector<KnownSurface> known_surfaces();

/// Random steps along the surface, in each axis, in shortest edges: large enough that no ring is regular any more, small enough that no
/// triangle turns over.
inline constexpr double jitter_amount = 0.2;

enum class Triangulation {
    regular,
    jittered   // the same triangles over vertices moved along the surface, by up to a fifth of their shortest edge in each axis
};

/// A mesh of a known surface, with the truth at its vertices.
struct SampledSurface {
    TriangleMesh mesh;
    MeshTopology topology;
    Positions normals;   // n × 3, outward unit normals of the surface
    Vector H, K;         // closed form [1/length], [1/length²]
    Vector areas;        // barycentric; the weights of L2 errors [length²]
    double mean_edge = 0;
    double smallest_angle = 0;   // [rad]
};
SampledSurface sampled(const KnownSurface& surface, int level, Triangulation triangulation, std::uint64_t seed);

/// The positions moved by up to `amount` times their shortest edge in each axis, uniformly distributed, and brought back to the surface by
/// `projected`. Boundary vertices stay. Below about 0.2 no triangle turns over.
Positions jittered(const TriangleMesh& mesh, const MeshTopology& topology, double amount, std::uint64_t seed,
                   const std::function<Vector3(const Vector3&)>& projected);

/// Levels of a refinement study, coarse to fine: five, or three for a quick look.
std::vector<int> refinement_levels(bool quick);

/// Order p of error ≈ c·h^p: least-squares slope of log error over log h, from the (up to) three finest entries, which come last.
/// NaN with fewer than two positive errors.
double fitted_order(const std::vector<double>& mean_edges, const std::vector<double>& errors);

}   // namespace meshfolio
