/// @file
/// The header of a PLY file (Turk 1994): its elements, their properties, and which of them make up the mesh.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/polygon_list.h"
#include "mesh/io/scalar_type.h"

namespace meshfolio {

/// Returns the name of the type in a header: "uchar", "float" …
std::string_view ply_name_of(ScalarType type);

struct PlyProperty {
    std::string name;
    ScalarType type;   // of the value, or of a list's items
    bool is_list = false;
    ScalarType count_type = ScalarType::uint8;   // of a list's length
    long line = 0;
};

struct PlyElement {
    std::string name;
    long long count;
    long line;   // of the header
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    enum class Format { ascii, little_endian, big_endian };
    Format format = Format::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;   // bytes
    long lines = 0;
};

/// Reads the header, and checks its counts against the bytes that follow.
/// @throws InputError with the header's line
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file);

/// The elements and properties that make up the mesh.
struct PlyMeshParts {
    const PlyElement* vertices;
    const PlyElement* faces;           // or `tristrips`, if there are no faces
    std::array<std::size_t, 3> axis;   // the properties x, y, z of a vertex
    std::size_t corners;               // the property of a face that lists its corners
    bool are_strips;                   // a row of `faces` holds strips of triangles, ended by −1
    const PlyElement* ignored;         // strips if there are faces as well; null: none

    bool is_corners(const PlyElement& element, std::size_t property) const { return &element == faces && property == corners; }
};

/// Returns the parts of the header that make up the mesh. @throws InputError naming the part that is missing
PlyMeshParts mesh_parts(const PlyHeader& header, const std::string& file);

}   // namespace meshfolio
