/// @file
/// The Hausdorff distance of two triangle surfaces, enclosed between two numbers.
#pragma once

#include <vector>

#include "geometry/measures/closest_point.h"

namespace meshfolio {

/// The largest distance of a point of either surface from the other lies in [distance, bound].
struct HausdorffDistance {
    double distance = 0;   // the largest measured at a point, to its rounding [length]
    double bound = 0;      // including rounding, at least that of the coordinates, 2⁻⁴² of their extent [length]
    bool reached = true;   // true: bound − distance is within the accuracy or rounding; false: the work reached its limit
};

inline constexpr double default_accuracy = 1e-3;                    // of (bound − distance)/distance
inline constexpr double least_accuracy = 1e-9, most_accuracy = 1;   // the range of accuracies

/// Computes the two-sided distance over all points of all triangles; triangles without area count as the segments and points that they are.
/// 0 if neither mesh has a triangle. Ends when no point can be farther than (1 + accuracy) times one found.
/// @throws MeshError if only one of them has no triangle
HausdorffDistance hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b, double accuracy = default_accuracy);

/// One direction of the search, with its known bounds.
struct DistanceSearch {
    const TriangleMesh& from;
    const ClosestPoint& to;
    Vector bounds;      // of the distance of all points of each triangle of `from`; ∞ if not known [length]
    double found = 0;   // the largest distance measured; the search raises it [length]
};

/// Encloses the larger of two one-sided distances: from `one.from` to `one.to` and from `other.from` to `other.to`. Raises `found` of the
/// side that has a distance larger than both; the other may stay below its own maximum. The accuracy is missed where the work has a limit.
/// @param accuracy  wanted (bound − distance)/distance @param rounding  of any distance [length]
HausdorffDistance enclose_farthest(DistanceSearch& one, DistanceSearch& other, double accuracy, double rounding);

}   // namespace meshfolio
