/// @file
/// Meshes from and to files. Reading is strict: what cannot be understood is an InputError with file and line; what
/// was understood but looked odd is a warning. Vertex order is the file's; STL and each mesh of a GLB, whose vertices are there once for
/// each of their faces or normals, are welded where positions are equal.
///
/// A new format is one `parse_…` function here, one line in the table of mesh_files.cpp, one encoder when it is written too.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/scalar_type.h"
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
    Attributes attributes = {};          // where they were asked for
};

enum class Keep { mesh, attributes };

inline constexpr char formats_read[] = "OBJ, OFF, PLY, STL, VTP or GLB, also packed by gzip; - for standard input";
inline constexpr char formats_written[] = "OBJ, OFF, PLY, STL, VTP or GLB; - for OBJ on standard output";

inline constexpr char attributes_are_kept[] =
    "Between PLY, VTP and GLB all values of vertices are kept, from OBJ to OBJ texture coordinates, groups and materials; normals are "
    "those\n"
    "of the new mesh.\n";

/// What a mesh from standard input is called. Its format is told by its content.
inline constexpr char standard_input[] = "standard input";

/// OBJ, OFF, PLY, STL, VTP or GLB by the file's ending (any case), gzip by its content.
/// @throws InputError if the file is missing, unusable, of unknown format, or has no triangle
LoadedMesh read_mesh(const std::filesystem::path& path, Keep keep = Keep::mesh);

/// The same from memory; `file` gives the format by its ending and stands in the messages.
LoadedMesh parse_mesh(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);

LoadedMesh parse_obj(std::string_view text, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_off(std::string_view text, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_ply(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_stl(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_vtp(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_glb(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);

/// OBJ (also for "-") or OFF (shortest exact decimals), PLY or VTP (binary little endian, double), STL or GLB (float) by the ending of
/// `file`.
/// @param attributes  of the file that the mesh was read from: its columns go into PLY, VTP and GLB, the text of an OBJ file is written
///                    with the new positions. Normals are those of the mesh.
/// @throws UsageError for another ending
std::string encode_mesh(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes = {});

/// What of it is lost or changed there, a sentence each: values that the format cannot hold, and triangles that rounding to its floats
/// spoils. To be told to whoever writes it.
std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes = {});

/// Of the formats that are read and written: ".obj" …
std::vector<std::string> mesh_endings();
/// Of those among them that hold columns.
std::vector<std::string> column_endings();

/// The file's name without folder and ending: "cow" of "meshes/cow.obj.gz".
std::string mesh_name(const std::string& file);

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
