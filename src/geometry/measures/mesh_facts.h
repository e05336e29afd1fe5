/// @file
/// What preflight measures beyond counting: extremes of edges and angles, place and size, how finely a file writes its coordinates, and
/// Gauss–Bonnet.
#pragma once

#include "mesh/mesh_checks.h"

namespace meshfolio {

/// Returns the spacing of coordinates as a file writes them, found from the numbers themselves: along each axis all differences are
/// multiples of it. It is 10⁻ᵈ for d decimals, or longer on a grid of equal steps; the spacing of single precision, of so many significant
/// digits or of doubles at the farthest coordinate, where they have more decimals. [length]
double written_spacing(const Positions& X);

struct MeshFacts {
    Preflight counts;
    double shortest_edge = 0, longest_edge = 0;   // [length]
    double smallest_angle = 0;                    // [rad]
    double diagonal = 0;                          // of the bounding box [length]
    double offset = 0;                            // of the box centre from the origin, in box diagonals
    int unreferenced_vertices = 0;
    double total_deficit = 0;           // Σ angle deficit [rad]
    double gauss_bonnet_residual = 0;   // |total_deficit/2π − χ|; rounding on manifold meshes, elsewhere without meaning

    /// Spacing of doubles at the farthest coordinate, over the shortest edge: how coarsely positions are stored. 0 with no length at all.
    double coordinate_rounding = 0;
    /// written_spacing() over the shortest edge: how coarsely the file has rounded. 1 or more on a grid, which needs no rounding; 0 of
    /// whole numbers, likewise, and with no length at all.
    double written_steps = 0;

    /// Has the file rounded so that it can be seen: by more than 10⁻⁹ of the shortest edge, and on no grid?
    bool is_rounded() const { return written_steps > 1e-9 && written_steps < 0.99; }
};
MeshFacts mesh_facts(const PreparedMesh& prepared);

/// Spacing of doubles at the farthest coordinate: positions are not known better, wherever they were computed. [length]
double coordinate_spacing(const TriangleMesh& mesh);

/// Largest change of cotangents, areas, H and K, each relative to its largest magnitude, when the mesh is scaled by `scale` (a power
/// of two) and moved by 2²⁰ box diagonals along each axis. The rounding that the move itself brings into the coordinates is in both
/// meshes compared, so what remains is how far the formulas depend on place and size.
double change_when_moved(const PreparedMesh& prepared, double scale);

}   // namespace meshfolio
