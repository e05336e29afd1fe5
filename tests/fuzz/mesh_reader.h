/// @file
/// The property of every mesh reader: whatever the bytes, either an Error with its one line or a mesh that holds together, and that is the
/// same after being written and read again.
#pragma once

#include <string>

#include "base/errors.h"
#include "fuzz/fuzz_input.h"
#include "mesh/io/mesh_files.h"

namespace meshfolio::fuzzing {

inline void require_sound(const TriangleMesh& mesh) {
    require(mesh.X.allFinite(), "positions are finite");
    require(mesh.F.rows() > 0, "a mesh that is accepted has a triangle");
    require(mesh.F.minCoeff() >= 0 && mesh.F.maxCoeff() < mesh.vertex_count(), "indices are vertices");
}

inline void require_same(const TriangleMesh& a, const TriangleMesh& b) {
    require(a.X.rows() == b.X.rows() && a.X == b.X, "positions survive writing and reading");
    require(a.F.rows() == b.F.rows() && a.F == b.F, "triangles survive writing and reading");
}

inline void read_any_mesh(LoadedMesh (*parse)(std::string_view, const std::string&), const std::string& file, std::string_view bytes) {
    LoadedMesh loaded;
    try {
        loaded = parse(bytes, file);
    } catch (const Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return;
    }
    require_sound(loaded.mesh);
    for (const char* name : {"again.obj", "again.off", "again.ply"}) {
        require_same(loaded.mesh, parse_mesh(encode_mesh(loaded.mesh, name), name).mesh);
    }
}

}   // namespace meshfolio::fuzzing
