/// @file
/// Meshes from and to files. Reading is strict: what cannot be understood is an InputError with file and line; what
/// was understood but looked odd is a warning. Vertex order is the file's (STL, which has none, is welded).
///
/// A new format is one `parse_…` function here, one line in the table of mesh_files.cpp, one encoder when it is written too.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct MeshWarning {
    std::string message;
    long line = 0;   // 0: the file as a whole
};

struct LoadedMesh {
    TriangleMesh mesh;                   // every polygon triangulated
    std::string file;                    // as it was asked for; for messages
    std::vector<long> face_lines;        // line of each triangle in the file; empty for binary formats
    std::vector<MeshWarning> warnings;   // at most one a kind: later ones are counted into the first
};

/// OBJ, OFF, PLY or STL by the file's ending (any case).
/// @throws InputError if the file is missing, unusable, of unknown format, or has no triangle
LoadedMesh read_mesh(const std::filesystem::path& path);

/// The same from memory; `file` gives the format by its ending and stands in the messages.
LoadedMesh parse_mesh(std::string_view bytes, const std::string& file);

LoadedMesh parse_obj(std::string_view text, const std::string& file);
LoadedMesh parse_off(std::string_view text, const std::string& file);
LoadedMesh parse_ply(std::string_view bytes, const std::string& file);
LoadedMesh parse_stl(std::string_view bytes, const std::string& file);

/// OBJ, OFF (shortest exact decimals) or PLY (binary little endian, double) by the ending of `file`.
/// @throws UsageError for another ending
std::string encode_mesh(const TriangleMesh& mesh, const std::string& file);

/// The ending of a file's name with its dot: ".obj" of "Cow.OBJ".
std::string lower_case_ending(const std::string& file);

/// Of a format that is read, by its ending?
bool is_mesh_file(const std::string& file);

/// encode_mesh into a file, checked.
/// @throws OutputError
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Triangles of a polygon given by its corner positions in order: the fan around its first corner where that is right (always
/// when convex), ear clipping in the plane of the Newell normal otherwise. Indices are into `corners`. Independent of where
/// the polygon lies and how large it is.
/// @throws MeshError with fewer than 3 corners or more than 32768
Faces triangulate_polygon(const Positions& corners);

}   // namespace meshfolio
