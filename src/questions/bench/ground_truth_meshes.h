/// @file
/// The meshes of the ground-truth panel: surfaces with closed forms, each as regular, random, noisy and stretched triangles.
#pragma once

#include <array>
#include <string_view>

#include "questions/bench/known_surfaces.h"

namespace meshfolio {

enum class MeshKind {
    regular,      // of known_surfaces(); grids cut along one diagonal on the open surfaces
    random,       // hulls of random points where they are convex; else points that wandered over the surface, flipped to Delaunay
    noisy,        // regular, each point moved along the normal by 1 % of the mean edge (standard deviation)
    anisotropic   // regular, but about four to one
};
inline constexpr std::array mesh_kinds{MeshKind::regular, MeshKind::random, MeshKind::noisy, MeshKind::anisotropic};
std::string_view name_of(MeshKind kind);

struct TruthSurface {
    KnownSurface surface;
    std::function<TriangleMesh(int level)> stretched;
    Vector3 half_axes = Vector3::Zero();   // of an ellipsoid about the origin; zero: not convex
};
/// Sphere, ellipsoid, ellipsoid band, torus, cylinder, catenoid, saddle.
std::vector<TruthSurface> truth_surfaces();

struct TruthMesh {
    TriangleMesh mesh;
    MeshTopology topology;
    Positions normals;            // n × 3, of the surface
    Vector H, K;                  // closed form [1/length], [1/length²]
    Vector areas;                 // barycentric: the weights of L2 errors [length²]
    std::vector<char> measured;   // at least three edges of level 2 from the boundary
    double mean_edge = 0;         // [length]
};
TruthMesh truth_mesh(const TruthSurface& surface, MeshKind kind, int level, std::uint64_t seed);
/// The hull of random points on an ellipsoid: the images of uniform points on the sphere.
TruthMesh random_ellipsoid(const Vector3& half_axes, int points, std::uint64_t seed);

}   // namespace meshfolio
