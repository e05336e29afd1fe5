/// @file
/// Binary glTF files from hand-written parts.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh/io/append_bytes.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio::testing {

/// Returns a file with this JSON text and data.
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

/// Returns the JSON text of a file of one mesh: float positions at byte 0, short indices at byte 1024.
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

/// A file made accessor by accessor; tests may change its `json`.
struct GlbParts {
    nlohmann::json json{{"asset", {{"version", "2.0"}}}, {"accessors", nlohmann::json::array()}, {"bufferViews", nlohmann::json::array()}};
    std::string data;

    template <class T> std::size_t view(const std::vector<T>& numbers) {
        data.resize((data.size() + 3) / 4 * 4);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", numbers.size() * sizeof(T)}});
        for (const T x : numbers) append(data, x);
        return json["bufferViews"].size() - 1;
    }

    template <class T> std::size_t accessor(const std::vector<T>& numbers, const std::string& type, bool normalized = false) {
        const int code = std::is_same_v<T, float> ? 5126
                                                  : 5120 +
                                                        (sizeof(T) == 1   ? 0
                                                         : sizeof(T) == 2 ? 2
                                                                          : 4) +
                                                        (std::is_unsigned_v<T> ? 1 : 0);
        const std::size_t columns = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type[3] - '0');
        const std::size_t from = view(numbers);
        json["accessors"].push_back({{"bufferView", from}, {"componentType", code}, {"type", type}, {"count", numbers.size() / columns}});
        if (normalized) json["accessors"].back()["normalized"] = true;
        return json["accessors"].size() - 1;
    }

    std::size_t positions(const TriangleMesh& mesh) {
        std::vector<float> numbers;
        for (const double x : mesh.X.reshaped<Eigen::RowMajor>()) numbers.push_back(static_cast<float>(x));
        return accessor(numbers, "VEC3");
    }

    std::size_t indices(const TriangleMesh& mesh) {
        std::vector<std::uint16_t> numbers;
        for (const int v : mesh.F.reshaped<Eigen::RowMajor>()) numbers.push_back(static_cast<std::uint16_t>(v));
        return accessor(numbers, "SCALAR");
    }

    /// Adds another mesh with a primitive of that mesh. Returns the primitive.
    nlohmann::json& add_mesh(const TriangleMesh& mesh) {
        const nlohmann::json primitive{{"attributes", {{"POSITION", positions(mesh)}}}, {"indices", indices(mesh)}};
        json["meshes"].push_back({{"primitives", nlohmann::json::array({primitive})}});
        return json["meshes"].back()["primitives"][0];
    }

    std::string bytes() {
        json["buffers"] = nlohmann::json::array({{{"byteLength", data.size()}}});
        return glb_of(json.dump(), data);
    }
};

}   // namespace meshfolio::testing
