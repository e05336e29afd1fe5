/// @file
/// Distances between any two triangle surfaces.
#pragma once

#include <vector>

#include "geometry/measures/hausdorff.h"

namespace meshfolio {

/// Distances from the points of one surface to another. Each triangle is divided into k² equal pieces, none larger than 1/16384 of the
/// surface. Means are over pieces, weighted by area and measured at centroids.
struct DistancesTo {
    Vector of_vertices;                     // n, NaN if no triangle uses the vertex [length]
    Vector of_pieces, areas;                // one a piece [length], [length²]
    double max = 0;                         // the largest measured [length]
    double mean = 0, rms = 0;               // NaN if nothing has an area [length]
    double mean_error = 0, rms_error = 0;   // bounds of their difference from the means over all points; NaN likewise [length]
    double mean_normal_angle = 0;           // between the normals of a piece and of the triangle nearest to it; NaN likewise [rad]
    bool exact = true;                      // false: a search reached its limit, and distances of vertices are upper bounds
};

struct SurfaceDistances {
    DistancesTo a_to_b, b_to_a;
    HausdorffDistance hausdorff;   // its distance is the larger maximum
    bool exact() const { return a_to_b.exact && b_to_a.exact; }
};

/// Measures the distances from a to b, from b to a, and the Hausdorff distance.
/// @param accuracy  of the Hausdorff distance: wanted (bound − distance)/distance
/// @throws MeshError if one of them has no triangle
SurfaceDistances surface_distances(const TriangleMesh& a, const TriangleMesh& b, double accuracy = default_accuracy);

/// Returns the distance of each vertex of `from` to the surface `to`; NaN if no triangle uses the vertex. [length]
/// @throws MeshError if `to` has no triangle
Vector vertex_distances(const TriangleMesh& from, const TriangleMesh& to);

/// Returns the shares of the area with distances in equal bins over [0, high], larger distances in the last bin; empty without any area.
std::vector<double> area_histogram(const DistancesTo& distances, double high, int bins);

}   // namespace meshfolio
