#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>

#include "base/at.h"
#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/ply_header.h"
#include "mesh/io/polygon_list.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

void check_coordinates(const TriangleMesh& mesh, const std::string& file) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.X.row(v).allFinite())
            throw MeshError("vertex " + std::to_string(v) + " is not finite", "such a mesh is not written", {file, 0});
        if (mesh.X.row(v).cwiseAbs().maxCoeff() > largest_coordinate)
            throw MeshError("vertex " + std::to_string(v) + " has a coordinate beyond 1e100", "no reader of ours would take it", {file, 0});
    }
}

void append_vertices(std::string& text, const TriangleMesh& mesh, const char* prefix) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        text += prefix;
        text += exact_text(mesh.X(v, 0)) + ' ' + exact_text(mesh.X(v, 1)) + ' ' + exact_text(mesh.X(v, 2)) + '\n';
    }
}

void append_faces(std::string& text, const TriangleMesh& mesh, const char* prefix, int first_index) {
    for (int t = 0; t < mesh.face_count(); ++t) {
        text += prefix;
        for (int k = 0; k < 3; ++k) text += std::to_string(mesh.F(t, k) + first_index) + (k < 2 ? ' ' : '\n');
    }
}

std::string obj_text(const TriangleMesh& mesh) {
    std::string text;
    append_vertices(text, mesh, "v ");
    append_faces(text, mesh, "f ", 1);
    return text;
}

std::string off_text(const TriangleMesh& mesh) {
    std::string text = "OFF\n" + std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count()) + " 0\n";
    append_vertices(text, mesh, "");
    append_faces(text, mesh, "3 ", 0);
    return text;
}

/// A name as headers take it: without blanks, and none that is there already.
std::string property_name(std::string name, std::set<std::string>& taken) {
    for (char& c : name) c = c > ' ' && c < 127 ? c : '_';
    while (name.empty() || !taken.insert(name).second) name += '_';
    return name;
}

/// A vertex without area has no normal, but viewers want one.
std::vector<VertexColumn> with_normals_of(const TriangleMesh& mesh, std::vector<VertexColumn> columns) {
    if (std::ranges::none_of(columns, is_normal)) return columns;
    const Positions normals = vertex_normals(mesh);
    for (VertexColumn& column : columns)
        if (is_normal(column)) column = {column.name, normals.col(column.name[1] - 'x'), ScalarType::float32};
    return columns;
}

std::string stl_bytes(const TriangleMesh& mesh, const std::string& file) {
    if (mesh.X.cwiseAbs().maxCoeff() > std::numeric_limits<float>::max())
        throw MeshError("a coordinate is beyond what the format can hold (3.4e38)", "write OBJ, OFF, PLY, VTP or GLB", {file, 0});
    const Positions normals = face_normals(mesh);
    std::string bytes(80, ' ');
    bytes.reserve(84 + at(mesh.face_count()) * 50);
    append_little_endian(bytes, static_cast<std::uint32_t>(mesh.face_count()));
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, static_cast<float>(normals(t, axis)));
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, static_cast<float>(mesh.X(mesh.F(t, k), axis)));
        append_little_endian(bytes, std::uint16_t{0});
    }
    return bytes;
}

}   // namespace

std::string ply_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
                        "\nproperty double x\nproperty double y\nproperty double z\n";
    std::set<std::string> taken{"x", "y", "z"};
    std::size_t row = 24;
    for (const VertexColumn& column : columns) {
        bytes += "property " + std::string(ply_name_of(column.type)) + ' ' + property_name(column.name, taken) + '\n';
        row += size_of(column.type);
    }
    bytes += "element face " + std::to_string(mesh.face_count()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    bytes.reserve(bytes.size() + at(mesh.vertex_count()) * row + at(mesh.face_count()) * 13);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, mesh.X(v, axis));
        for (const VertexColumn& column : columns)
            with_zero_of(column.type, [&](auto zero) { append_little_endian(bytes, static_cast<decltype(zero)>(column.values[v])); });
    }
    for (int t = 0; t < mesh.face_count(); ++t) {
        bytes += '\x03';
        for (int k = 0; k < 3; ++k) append_little_endian(bytes, static_cast<std::int32_t>(mesh.F(t, k)));
    }
    return bytes;
}

std::string encode_mesh(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes) {
    check_coordinates(mesh, file);
    const std::string ending = file == "-" ? ".obj" : lower_case_ending(file);
    if (ending == ".obj") return attributes.obj.empty() ? obj_text(mesh) : obj_with_positions(attributes, mesh);
    if (ending == ".off") return off_text(mesh);
    if (ending == ".ply") return ply_bytes(mesh, with_normals_of(mesh, attributes.columns));
    if (ending == ".vtp") return vtp_bytes(mesh, with_normals_of(mesh, attributes.columns));
    if (ending == ".stl") return stl_bytes(mesh, file);
    if (ending == ".glb") return glb_bytes(mesh, attributes.columns);
    throw UsageError("cannot write a mesh as '" + ending + "'", "name the file .obj, .off, .ply, .stl, .vtp or .glb", {file, 0});
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) { write_file(path, encode_mesh(mesh, path.string())); }

}   // namespace meshfolio
