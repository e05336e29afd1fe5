/// @file
/// The property of every mesh reader: any bytes give either an Error of one line or a sound mesh that is the same after it has been written
/// and read again.
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

/// Requires equal columns, except for normals, which are computed anew, and for the last bits of floats.
inline void require_same(const std::vector<VertexColumn>& a, const std::vector<VertexColumn>& b) {
    require(a.size() == b.size(), "columns survive writing and reading");
    for (std::size_t i = 0; i < a.size(); ++i) {
        require(a[i].type == b[i].type || a[i].name.starts_with('n'), "types survive writing and reading");
        for (Eigen::Index v = 0; is_integer(a[i].type) && is_integer(b[i].type) && v < a[i].values.size(); ++v)
            require(a[i].values[v] == b[i].values[v], "whole numbers survive writing and reading");
    }
}

inline void read_any_mesh(LoadedMesh (*parse)(std::string_view, const std::string&, Keep), const std::string& file,
                          std::string_view bytes) {
    LoadedMesh loaded;
    try {
        loaded = parse(bytes, file, Keep::attributes);
    } catch (const Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
        return;
    }
    require_sound(loaded.mesh);
    for (const char* name : {"again.obj", "again.off", "again.ply"}) {
        const LoadedMesh again = parse_mesh(encode_mesh(loaded.mesh, name, loaded.attributes), name, Keep::attributes);
        require_same(loaded.mesh, again.mesh);
        if (!again.attributes.columns.empty()) require_same(loaded.attributes.columns, again.attributes.columns);
    }
}

}   // namespace meshfolio::fuzzing
