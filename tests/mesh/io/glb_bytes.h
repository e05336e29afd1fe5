/// @file
/// Binary glTF by hand.
#pragma once

#include <cstdint>
#include <string>

#include "mesh/io/append_bytes.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio::testing {

/// A file of a text and its data.
inline std::string glb_of(std::string json, std::string data) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(28 + json.size() + data.size()));
    append(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append(bytes, static_cast<std::uint32_t>(data.size()));
    return bytes.append("BIN\0", 4) + data;
}

/// The text of a file of one mesh: float positions at byte 0, short indices at byte 1024.
inline std::string glb_text(const TriangleMesh& mesh, const std::string& node = "", const std::string& primitive = "",
                            const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
           R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" + primitive +
           R"(}]}],"buffers":[{"byteLength":2048}],"bufferViews":[{"buffer":0,"byteLength":1024},{"buffer":0,"byteOffset":1024,"byteLength":1024}],)" +
           R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" + std::to_string(mesh.X.rows()) +
           R"(},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":)" + std::to_string(mesh.F.size()) + "}]" + more + "}";
}

inline std::string glb_data(const TriangleMesh& mesh) {
    std::string data;
    for (const double x : mesh.X.reshaped<Eigen::RowMajor>()) append(data, static_cast<float>(x));
    data.resize(1024);
    for (const int v : mesh.F.reshaped<Eigen::RowMajor>()) append(data, static_cast<std::uint16_t>(v));
    data.resize(2048);
    return data;
}

}   // namespace meshfolio::testing
