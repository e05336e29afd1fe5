/// @file
/// Surfaces with curvature in closed form, as meshes of any fineness.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "report/words.h"

namespace meshfolio {

struct CurvaturePair;

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

}   // namespace meshfolio
