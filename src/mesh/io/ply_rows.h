/// @file
/// Where in a PLY file the mesh stands; and the short way to read what nearly all binary files are: triangles in rows of one length.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/io/ply_header.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// The elements and properties that make up the mesh.
struct PlyMeshParts {
    const PlyElement* vertices;
    const PlyElement* faces;           // or `tristrips`, where there are no faces
    std::array<std::size_t, 3> axis;   // which property of a vertex is x, y, z
    std::size_t corners;               // which property of a face is the list of its corners
    bool are_strips;                   // a row of `faces` holds strips of triangles, ended by −1
    const PlyElement* ignored;         // strips beside faces; null without

    bool is_corners(const PlyElement& element, std::size_t property) const { return &element == faces && property == corners; }
};

/// @throws InputError naming what is missing
PlyMeshParts mesh_parts(const PlyHeader& header, const std::string& file);

struct PlyTriangles {
    TriangleMesh mesh;
    std::size_t end;   // of the last element, in bytes from the beginning of the file
};

/// Reads a binary file whose numbers are in the order of this machine, whose rows all have the same length, and whose faces are all
/// triangles, in parallel. Nothing where the file is different, or anything is wrong with it: then the reader that goes from value to
/// value takes it, and says what.
std::optional<PlyTriangles> read_triangle_rows(std::string_view bytes, const PlyHeader& header, const PlyMeshParts& parts);

}   // namespace meshfolio
