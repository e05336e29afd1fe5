/// @file
/// The meshes earlier reports worked on which are not ours to distribute, and what stands for each where no data folder has it.
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
std::span<const StandIn> stand_in_list();

/// A mesh that is spoken of by name: the original, or what is measured in its place.
struct ReportMesh {
    SharedMesh mesh;
    bool original = false;            // the very mesh that is spoken of
    bool own = false;                 // the user's, which takes every place
    const StandIn* entry = nullptr;   // null for the roles of the assignment
    std::string_view asked = {};      // what the name means: "bunny.off", "curvatures/plane.obj", or a bundled file

    /// "bunny", or "creature in place of bunny.off"; of the user's own mesh, its name.
    std::string called() const;
    report::Input input() const;
};

/// Finds a mesh by a name of the list, else by a role. The user's own mesh replaces all.
ReportMesh report_mesh(const MeshLibrary& library, std::string_view name);

}   // namespace meshfolio
