/// @file
/// Measures of preflight beyond counts: extremes of edges and angles, place, size, rounding of coordinates in files, Gauss–Bonnet.
#pragma once

#include "mesh/mesh_checks.h"

namespace meshfolio {

/// Returns the spacing of coordinates as a file writes them, found from the numbers themselves: along each axis all differences are
/// multiples of it. It is 10⁻ᵈ for d decimals, or longer on a grid of equal steps. If numbers have more decimals, it is the spacing, at the
/// farthest coordinate, of single precision, of the significant digits written, or of doubles. [length]
double written_spacing(const Positions& X);

/// The measures of one mesh.
struct MeshFacts {
    Preflight counts;
    double shortest_edge = 0, longest_edge = 0;   // [length]
    double smallest_angle = 0;                    // [rad]
    double diagonal = 0;                          // of the bounding box [length]
    double offset = 0;                            // of the box centre from the origin, in box diagonals
    int unreferenced_vertices = 0;
    double total_deficit = 0;           // Σ angle deficit [rad]
    double gauss_bonnet_residual = 0;   // |total_deficit/2π − χ|; rounding on manifold meshes, elsewhere without meaning

    /// Spacing of doubles at the farthest coordinate over the shortest edge: the rounding of stored positions. 0 without any length.
    double coordinate_rounding = 0;
    /// written_spacing() over the shortest edge: the rounding of the file. 1 or more on a grid, which needs no rounding; 0 for whole
    /// numbers, likewise, and without any length.
    double written_steps = 0;

    /// True if rounding by the file is visible: more than 10⁻⁹ of the shortest edge, and not on a grid.
    bool is_rounded() const { return written_steps > 1e-9 && written_steps < 0.99; }
};
/// Computes all measures of a prepared mesh.
MeshFacts mesh_facts(const PreparedMesh& prepared);

/// Returns the spacing of doubles at the farthest coordinate, the accuracy of any stored position. [length]
double coordinate_spacing(const TriangleMesh& mesh);

/// Returns the largest change of cotangents, areas, H and K, each relative to its largest magnitude, when the mesh is scaled by `scale` (a
/// power of two) and moved by 2²⁰ box diagonals along each axis. Both meshes compared contain the rounding of coordinates by the move, so
/// the change shows how far the formulas depend on place and size.
double change_when_moved(const PreparedMesh& prepared, double scale);

}   // namespace meshfolio
