/// @file
/// How far any two triangle surfaces are apart, whatever their triangles.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// From the points of one surface to the nearest of another. Each triangle is divided into k² equal pieces, none of them larger than
/// 1/16384 of the surface. Means are over pieces, weighted by area and measured at centroids; maxima over centroids and vertices.
struct DistancesTo {
    Vector of_vertices;                  // n, NaN where no triangle uses the vertex [length]
    Vector of_pieces, areas;             // one a piece [length], [length²]
    double max = 0, mean = 0, rms = 0;   // means are NaN where nothing has an area [length]
    double mean_normal_angle = 0;        // between the normals of a piece and of the triangle nearest to it; NaN likewise [rad]
};

struct SurfaceDistances {
    DistancesTo a_to_b, b_to_a;
    double hausdorff() const;   // the larger maximum [length]
};

/// @throws MeshError if one of them has no triangle
SurfaceDistances surface_distances(const TriangleMesh& a, const TriangleMesh& b);

/// DistancesTo::of_vertices alone. @throws MeshError if one of them has no triangle
Vector vertex_distances(const TriangleMesh& from, const TriangleMesh& to);

/// Shares of the area at distances in equal bins over [0, high]; empty without any area.
std::vector<double> area_histogram(const DistancesTo& distances, double high, int bins);

}   // namespace meshfolio
