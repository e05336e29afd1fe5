/// @file
/// The meshes of earlier reports that are not ours to distribute, and the bundled meshes that stand in for them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "questions/core/mesh_library.h"

namespace meshfolio {

struct StandIn {
    std::string_view name;   // "bunny"
    std::string_view file;   // looked for in the data folders: "bunny.off"
    std::string_view role;   // of the mesh in its place
    /// Measures of the original: they identify it and scale its parameters to another mesh.
    double critical = 0;    // λ_crit, ½-cotangent operator with barycentric areas [length²]
    double mean_edge = 0;   // [length]
    int vertices = 0, triangles = 0;
};
/// Returns the entries of bunny, cow, cube and bumpy_cube.
std::span<const StandIn> stand_in_list();

/// A mesh of an earlier report: the original, or its stand-in.
struct ReportMesh {
    SharedMesh mesh;
    bool original = false;            // not a stand-in
    bool own = false;                 // the user's, which takes every place
    const StandIn* entry = nullptr;   // null for the roles of the assignment
    std::string_view asked = {};      // file that the name stands for: "bunny.off", "curvatures/plane.obj", or a bundled one

    /// Returns "bunny", "creature in place of bunny.off", or the name of the user's own mesh.
    std::string called() const;
    /// Returns the input of the mesh; with the name and file of the entry as its role and the file asked for, unless it is the user's own.
    report::Input input() const;
};

/// Finds a mesh by a name of stand_in_list(), in a data folder or else its stand-in; or by a role. The user's first own mesh replaces all.
ReportMesh report_mesh(const MeshLibrary& library, std::string_view name);

}   // namespace meshfolio
