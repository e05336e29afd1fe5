/// @file
/// Surfaces with curvature in closed form, and meshes of them in five kinds of triangles, with the true curvature at their vertices.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/curvature/analytic_surfaces.h"
#include "geometry/linear/sparse_types.h"
#include "geometry/linear/special_values.h"
#include "mesh/mesh_topology.h"
#include "questions/core/mesh_library.h"
#include "report/words.h"

namespace meshfolio {

inline constexpr report::Words curvature_words("curvature");

struct KnownSurface {
    std::string name = {};         // "torus"
    std::string dimensions = {};   // "R = 1, r = 0.4"
    // Vertices lie on the surface; each level halves the edges.
    std::function<TriangleMesh(int level)> mesh_at;
    std::function<TriangleMesh(int level)> stretched_at = {};    // triangles of about four to one
    std::function<Vector3(const Vector3&)> projected;            // a nearby point onto the surface
    std::function<Vector3(const Vector3&)> normal_at;            // unit, outward, at a point of the surface
    std::function<CurvaturePair(const Vector3&)> curvature_at;   // at a point of the surface
    Vector3 half_axes = Vector3::Zero();                         // of an ellipsoid about the origin; zero: not convex
};

/// Returns sphere, ellipsoid, ellipsoid band, torus, cylinder, catenoid and saddle.
std::vector<KnownSurface> known_surfaces();
/// Returns the known surface of this name. @throws std::logic_error if there is none
KnownSurface known_surface(const std::string& name);
/// Returns an ellipsoid about the origin, without a name.
KnownSurface ellipsoid_surface(const Vector3& half_axes);

enum class MeshKind {
    regular,      // of known_surfaces(): icospheres, and grids cut along one diagonal
    jittered,     // regular, vertices moved along the surface, by up to a fifth of their shortest edge in each axis
    random,       // on convex surfaces the hull of random points; else points jittered several times and flipped to Delaunay
    noisy,        // regular, each point moved along the normal by 1 % of the mean edge (standard deviation)
    anisotropic   // regular, but about four to one
};
std::string_view name_of(MeshKind kind);   // "regular"

struct BenchMesh {
    TriangleMesh mesh;
    MeshTopology topology;
    Positions normals;            // n × 3, of the surface
    Vector H, K;                  // closed form [1/length], [1/length²]
    Vector areas;                 // barycentric: the weights of L2 errors [length²]
    std::vector<char> measured;   // at least three edges of level 2 from the boundary
    double mean_edge = 0;         // [length]

    /// Returns the value of this name; the first call on this mesh or a copy of it makes the value by make().
    const auto& shared(const std::string& name, const auto& make) const { return shared_->value(name, make); }
    const SparseMatrix& C() const;          // cotangent stiffness
    const Vector& angle_deficits() const;   // n values 2π − Σθ, on the boundary π − Σθ [rad]

private:
    std::shared_ptr<OnceMap> shared_ = std::make_shared<OnceMap>();   // by copies, too
};
/// Makes a mesh of the surface with the true normals and curvatures at its vertices; each level halves the edges.
BenchMesh bench_mesh(const KnownSurface& surface, MeshKind kind, int level, std::uint64_t seed);
/// Makes the hull of random points on an ellipsoid, the images of uniform points on the sphere, with the true normals and curvatures.
BenchMesh random_ellipsoid(const Vector3& half_axes, int points, std::uint64_t seed);

/// Returns positions with each inner vertex moved by a uniform random step of up to ± `amount` of its shortest edge in each axis, then
/// mapped by `projected`; boundary vertices stay. No triangle turns over while `amount` is below 0.2.
Positions jittered(const TriangleMesh& mesh, const MeshTopology& topology, double amount, std::uint64_t seed,
                   const std::function<Vector3(const Vector3&)>& projected);

/// Counts of edges with a negative weight in C, and the smallest weight of all edges.
struct NegativeWeights {
    int inside = 0, boundary = 0;
    double smallest = infinity;   // stays so without edges
};
/// Counts the edges with C_ij < −1e-9, with one face (boundary) and with more (inside), and finds the smallest C_ij of all edges.
NegativeWeights negative_weights(const SparseMatrix& C, const MeshTopology& topology);

}   // namespace meshfolio
