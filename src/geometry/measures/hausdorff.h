/// @file
/// The Hausdorff distance of two triangle surfaces, enclosed between two numbers.
#pragma once

#include <vector>

#include "geometry/measures/closest_point.h"

namespace meshfolio {

/// max over the points of each surface of the distance to the other lies in [distance, bound].
struct HausdorffDistance {
    double distance = 0;   // the largest that was measured at a point, to its rounding [length]
    double bound = 0;      // with all rounding: never below the coordinates' own, 2⁻⁴² of their extent [length]
    bool reached = true;   // bound − distance is within the accuracy, or within rounding; false: the work reached its limit
};

inline constexpr double default_accuracy = 1e-3;                    // of (bound − distance)/distance
inline constexpr double least_accuracy = 1e-9, most_accuracy = 1;   // what may be asked for

/// Two-sided, over all points of all triangles, those without area being the segments and points that they are; 0 where neither has a
/// triangle. Both directions share one search, which ends when no point can be farther than (1 + accuracy) times one that was found.
/// @throws MeshError if one of them alone has no triangle
HausdorffDistance hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b, double accuracy = default_accuracy);

/// One direction of the search, with what is known before it.
struct DistanceSearch {
    const TriangleMesh& from;
    const ClosestPoint& to;
    Vector bounds;      // one a triangle of `from`: no point of it is farther away; ∞ where nothing is known [length]
    double found = 0;   // a distance that was measured; the search raises it [length]
};

/// Encloses the larger of both maxima. @param rounding  of any distance [length]
HausdorffDistance enclose_farthest(DistanceSearch& one, DistanceSearch& other, double accuracy, double rounding);

}   // namespace meshfolio
