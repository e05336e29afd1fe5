/// @file
/// The meshes that estimators of curvature are measured on: known surfaces in five kinds of triangles, with the truth at their vertices.
#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/linear/sparse_types.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

struct KnownSurface;

enum class MeshKind {
    regular,      // of known_surfaces(): icospheres, and grids cut along one diagonal
    jittered,     // regular, vertices moved along the surface, by up to a fifth of their shortest edge in each axis
    random,       // hulls of random points on convex surfaces; else points that wandered over the surface, flipped to Delaunay
    noisy,        // regular, each point moved along the normal by 1 % of the mean edge (standard deviation)
    anisotropic   // regular, but about four to one
};
std::string_view name_of(MeshKind kind);

struct BenchMesh {
    TriangleMesh mesh;
    MeshTopology topology;
    Positions normals;            // n × 3, of the surface
    Vector H, K;                  // closed form [1/length], [1/length²]
    Vector areas;                 // barycentric: the weights of L2 errors [length²]
    std::vector<char> measured;   // at least three edges of level 2 from the boundary
    double mean_edge = 0;         // [length]

    /// What several estimators need: made when the first asks for it by this name, then kept. Not for several threads at once.
    template <class Make>
    const auto& shared(const std::string& name, const Make& make) const {
        std::any& kept = kept_[name];
        if (!kept.has_value()) kept = make();
        return *std::any_cast<decltype(make())>(&kept);
    }
    /// The cotangent stiffness matrix.
    const SparseMatrix& C() const;
    const Vector& angle_deficits() const;

private:
    mutable std::map<std::string, std::any> kept_;
};
BenchMesh bench_mesh(const KnownSurface& surface, MeshKind kind, int level, std::uint64_t seed);
/// The hull of random points on an ellipsoid: the images of uniform points on the sphere.
BenchMesh random_ellipsoid(const Vector3& half_axes, int points, std::uint64_t seed);

/// Moves each inner vertex uniformly by up to `amount` of its shortest edge in each axis, then projects it. Below 0.2 no triangle turns
/// over.
Positions jittered(const TriangleMesh& mesh, const MeshTopology& topology, double amount, std::uint64_t seed,
                   const std::function<Vector3(const Vector3&)>& projected);

/// Edges with a negative weight in C, and the smallest weight of all, whatever its sign; infinite without edges.
struct NegativeWeights {
    int inside = 0, boundary = 0;
    double smallest = 0;
};
NegativeWeights negative_weights(const SparseMatrix& C, const MeshTopology& topology);

}   // namespace meshfolio
