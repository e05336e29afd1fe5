/// @file
/// Meshes from and to files. Readers are strict: errors of a file are InputErrors with file and line; oddities are warnings. Vertices have
/// the order of the file. STL and GLB repeat vertices for each face or normal: those at equal positions, in one mesh of a GLB, become one.
///
/// A new format needs a `parse_…` function here, a line in the table of mesh_files.cpp, and an encoder if it is written too.
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
    std::string file;                    // its name, for messages
    std::vector<long> face_lines;        // line of each triangle in the file; empty for binary formats
    std::vector<MeshWarning> warnings;   // at most one per kind, with the number of cases
    Attributes attributes = {};          // if they were asked for
};

/// The content of a file that a reader returns: the mesh alone, or its attributes as well.
enum class Keep { mesh, attributes };

inline constexpr char formats_read[] = "OBJ, OFF, PLY, STL, VTP or GLB, also packed by gzip; - for standard input";
inline constexpr char formats_written[] = "OBJ, OFF, PLY, STL, VTP or GLB; - for OBJ on standard output";

inline constexpr char attributes_are_kept[] =
    "Between PLY, VTP and GLB all values of vertices are kept, from OBJ to OBJ texture coordinates, groups and materials; normals are "
    "those\n"
    "of the new mesh.\n";

/// The name of a mesh from standard input. Its format is found by its content.
inline constexpr char standard_input[] = "standard input";

/// Reads a mesh from an OBJ, OFF, PLY, STL, VTP or GLB file, by its ending (any case); recognises gzip by its content.
/// @throws InputError if the file is missing, unusable, of unknown format, or has no triangle
LoadedMesh read_mesh(const std::filesystem::path& path, Keep keep = Keep::mesh);

/// Reads a mesh from memory, packed by gzip or not. @param file  gives the format by its ending and is named in messages @throws InputError
/// as read_mesh()
LoadedMesh parse_mesh(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);

/// Reads a mesh of one format from memory, whatever the ending of `file`, which messages name. @throws InputError as read_mesh()
LoadedMesh parse_obj(std::string_view text, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_off(std::string_view text, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_ply(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_stl(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_vtp(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);
LoadedMesh parse_glb(std::string_view bytes, const std::string& file, Keep keep = Keep::mesh);

/// Returns the bytes of a file: OBJ (also for "-") or OFF (shortest exact decimals), PLY or VTP (binary little endian, double), STL or GLB
/// (float), by the ending of `file`.
/// @param attributes  of the file that the mesh was read from: its columns go into PLY, VTP and GLB, the text of an OBJ file is written
///                    with the new positions. Normals are those of the mesh.
/// @throws MeshError if a coordinate is not finite or beyond the format; UsageError for another ending
std::string encode_mesh(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes = {});

/// Returns a sentence for each loss in the file that encode_mesh() gives, to be shown: values that the format cannot hold, and damage by
/// rounding to its floats. Empty if nothing is lost.
std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes = {});

/// Returns the endings of the formats that are read and written: ".obj" …
std::vector<std::string> mesh_endings();
/// Returns the endings of the formats that hold values of vertices: ".ply", ".vtp", ".glb".
std::vector<std::string> column_endings();

/// Returns the file's name without folder and ending: "cow" for "meshes/cow.obj.gz".
std::string mesh_name(const std::string& file);

/// True if the name has the ending of a format that is read, perhaps followed by ".gz".
bool is_mesh_file(const std::string& file);

/// Writes encode_mesh() into a file. @throws as encode_mesh(), and OutputError if the file cannot be written
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}   // namespace meshfolio
