/// @file
/// The orientation of closed shells: bodies, cavities in them, islands in these.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Closed, consistently oriented parts of a surface.
struct Shells {
    std::vector<int> of_face;   // m numbers of shells from 0; −1: of no shell
    std::vector<int> sign;      // c signs of the enclosed volumes: 1, 0 or −1
};

enum class Turn {
    none,
    outwards,   // it bounds a body, but points into it
    inwards,    // it bounds a cavity, but points into the body around
    unknown,    // too many shells lie within too many others
};

/// Returns a turn for each of the c shells, after which shells at even nesting depth enclose a positive volume, and those at odd depth, the
/// cavities, a negative one. The depth of a shell is the number of other shells that hold it. A shell holds another if its winding number
/// (Jacobson et al. 2013, by signed crossings along a ray) differs from 0 at all points of the other that do not lie on it, and such a
/// point exists. Points are the corners and centroids of up to 4096 triangles; "on" allows for 1e-6 of the other's diagonal. Of two shells
/// that intersect, neither holds the other. Of two shells of opposite sign in one place, such as a cavity and the body that fills it,
/// neither is turned.
/// @param flip  m flags: the triangle counts as turned round
std::vector<Turn> turns_by_nesting(const TriangleMesh& mesh, const std::vector<char>& flip, const Shells& shells);

}   // namespace meshfolio
