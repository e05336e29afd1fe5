#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"

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

template <class T>
void append_little_endian(std::string& bytes, T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) {
        for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    }
    bytes.append(raw.data(), raw.size());
}

std::string ply_bytes(const TriangleMesh& mesh) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
                        "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(mesh.face_count()) +
                        "\nproperty list uchar int vertex_indices\nend_header\n";
    bytes.reserve(bytes.size() + static_cast<std::size_t>(mesh.X.size()) * 8 + static_cast<std::size_t>(mesh.face_count()) * 13);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, mesh.X(v, axis));
    }
    for (int t = 0; t < mesh.face_count(); ++t) {
        bytes += '\x03';
        for (int k = 0; k < 3; ++k) append_little_endian(bytes, static_cast<std::int32_t>(mesh.F(t, k)));
    }
    return bytes;
}

}   // namespace

std::string encode_mesh(const TriangleMesh& mesh, const std::string& file) {
    check_coordinates(mesh, file);
    const std::string ending = lower_case_ending(file);
    if (ending == ".obj") return obj_text(mesh);
    if (ending == ".off") return off_text(mesh);
    if (ending == ".ply") return ply_bytes(mesh);
    throw UsageError("cannot write a mesh as '" + ending + "'", "name the file .obj, .off or .ply", {file, 0});
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) { write_file(path, encode_mesh(mesh, path.string())); }

}   // namespace meshfolio
