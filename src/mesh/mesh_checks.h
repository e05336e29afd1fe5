/// @file
/// Preflight: counts of a mesh, its defects, and the repairs made before anything is computed.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mesh/io/mesh_files.h"
#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Preflight {
    int vertices = 0;          // rows of X
    int vertices_in_use = 0;   // those that triangles use
    int triangles = 0;         // kept
    int edges = 0;
    int components = 0;
    int boundary_edges = 0;
    int boundary_loops = 0;
    int euler_characteristic = 0;   // vertices in use − edges + triangles
    int genus = -1;                 // of one orientable manifold component; −1 where that is not defined
    int nonmanifold_edges = 0;
    int nonmanifold_vertices = 0;
    int zero_area_faces = 0;                                    // kept; they contribute neither stiffness nor mass
    int needle_faces = 0;                                       // kept; smallest angle below 1°
    int duplicated_positions = 0;                               // vertices in use that lie exactly on an earlier one
    double area = 0;                                            // [length²]
    int unbalanced_edges = 0;                                   // edges_out_of_balance() in orientation.h
    double volume = std::numeric_limits<double>::quiet_NaN();   // signed; NaN unless encloses_volume() [length³]
    double mean_edge = 0;                                       // [length]
    Vector3 box_low{0, 0, 0}, box_high{0, 0, 0};
    bool orientable = true;
    // Repairs
    int dropped_degenerate_faces = 0;   // a corner named twice
    int dropped_duplicate_faces = 0;    // the same three corners again, the same way round
    int opposite_faces = 0;             // pairs with the same three corners, one the other way round; both are kept
    int flipped_faces = 0;              // turned to agree with their component
    int inside_out_components = 0;      // closed components turned because of their nesting depth (nesting.h)

    bool closed() const { return boundary_edges == 0; }
    bool encloses_volume() const { return unbalanced_edges == 0; }
    bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
};

struct PreparedMesh {
    TriangleMesh mesh;       // vertex rows as in the file
    MeshTopology topology;   // of `mesh`
    Preflight preflight;
    std::vector<MeshWarning> warnings;   // the reader's, then one for each repair or defect above
    std::string file;
    Attributes attributes = {};   // of the file, if they were asked for; `face_lines` belong to the triangles that were kept
};

/// The extent of the checks. Repairs and warnings are the same in both cases.
enum class Checks {
    all,
    /// Enough for a picture or a spectrum, in half the time. `edges` and `neighbours` of the topology stay empty; so do, in the preflight,
    /// edges, boundary and unbalanced edges, boundary loops, Euler characteristic, genus, duplicated positions, area, volume, mean edge.
    for_pictures,
};

/// Prepares a mesh for computations: drops faces that name a corner twice and repeated faces, orients each component consistently (closed
/// ones by their nesting depth), and counts everything else.
/// @throws InputError if no triangle is left, all vertices coincide, a coordinate is not finite or exceeds 1e100 in magnitude, or a
/// triangle names a vertex that does not exist
PreparedMesh prepare_mesh(LoadedMesh loaded, Checks checks = Checks::all);

}   // namespace meshfolio
