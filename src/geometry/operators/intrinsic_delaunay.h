/// @file
/// The intrinsic Delaunay triangulation of a surface of flat triangles (Bobenko & Springborn 2007): the same surface, with straight edges
/// drawn over it so that the two angles opposite an edge never sum to more than π. Its cotangent weights are ≥ 0 at interior edges.
#pragma once

#include "geometry/operators/intrinsic_triangles.h"

namespace meshfolio {

struct IntrinsicDelaunay {
    IntrinsicTriangles triangles;
    int flips = 0;
};

/// Flips edges until all that are glued are Delaunay; the others stay. Edges are taken in the order of their triangles. An edge
/// whose opposite angles sum to π within 1e-10 is left as it is: flipping it would change nothing but rounding.
/// @throws SolverError if it does not come to an end, which rounding can bring about in triangles without area
IntrinsicDelaunay intrinsic_delaunay(IntrinsicTriangles triangles);

}   // namespace meshfolio
