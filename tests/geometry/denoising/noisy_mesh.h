/// @file
/// Meshes to be denoised.
#pragma once

#include <cstdint>

#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio::testing {

/// Returns the mesh with Gaussian noise on each coordinate, in mean edges.
inline TriangleMesh noisy(const TriangleMesh& mesh, double edges, std::uint64_t seed = 3) {
    return moved_to(mesh, with_gaussian_noise(mesh.X, Vector3::Constant(edges * mean_edge_length(mesh)), seed));
}

}   // namespace meshfolio::testing
