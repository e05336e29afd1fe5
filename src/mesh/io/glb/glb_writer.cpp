#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/at.h"
#include "mesh/io/glb/glb_parts.h"
#include "mesh/io/mesh_encoders.h"

namespace meshfolio {

namespace {

using OrderedJson = nlohmann::ordered_json;
enum Component { unsigned_short = 5123, unsigned_int = 5125, float_type = 5126 };
enum Target { vertex_data = 34962, index_data = 34963 };

/// Returns the nearest finite float; 0 for NaN.
float finite(double x) {
    constexpr double largest = std::numeric_limits<float>::max();
    return std::isnan(x) ? 0 : static_cast<float>(std::clamp(x, -largest, largest));
}

void append_uint32(std::string& bytes, std::size_t number) { append_little_endian(bytes, static_cast<std::uint32_t>(number)); }

/// Collects the lists of a file of glTF and its data.
class GlbWriter {
public:
    explicit GlbWriter(const TriangleMesh& mesh) : mesh_(mesh), frame_(float_frame(mesh)) {}

    void add_positions() {
        std::array<float, 3> low{}, high{};
        for (int axis = 0; axis < 3; ++axis) {
            low[at(axis)] = stored(mesh_.X.col(axis).minCoeff(), axis);
            high[at(axis)] = stored(mesh_.X.col(axis).maxCoeff(), axis);
        }
        attribute("POSITION", {{"componentType", float_type}, {"type", "VEC3"}, {"min", low}, {"max", high}}, 12, [&](Eigen::Index v) {
            for (int axis = 0; axis < 3; ++axis) append_little_endian(data_, stored(mesh_.X(v, axis), axis));
        });
    }

    void add_values(const std::string& name, ColumnGroup group) {
        static constexpr std::array shapes{"SCALAR", "VEC2", "VEC3", "VEC4"};
        attribute("_" + name, {{"componentType", float_type}, {"type", shapes[group.size() - 1]}}, 4 * group.size(), [&](Eigen::Index v) {
            for (const VertexColumn& column : group) append_little_endian(data_, finite(column.values[v]));
        });
    }

    /// Adds a colour in linear light (§3.7.2.1): 16 bits, which hold all values of 8 bits of sRGB, or floats. The alpha is linear already.
    void add_color(ColumnGroup channels) {
        const ScalarType type = channels.front().type;
        const double largest = type == ScalarType::uint8 ? 255 : type == ScalarType::uint16 ? 65535 : 1;
        const bool is_float = type == ScalarType::float32;
        const std::size_t row = is_float ? 4 * channels.size() : 8;
        const OrderedJson description{{"componentType", is_float ? float_type : unsigned_short},
                                      {"normalized", !is_float},
                                      {"type", channels.size() == 4 ? "VEC4" : "VEC3"}};
        attribute("COLOR_0", description, row, [&](Eigen::Index v) {
            const std::size_t end = data_.size() + row;
            for (std::size_t k = 0; k < channels.size(); ++k) {
                const double value = std::isnan(channels[k].values[v]) ? 1 : channels[k].values[v] / largest;
                const double linear = k == 3 ? value : linear_of_srgb(value);
                if (is_float) append_little_endian(data_, static_cast<float>(linear));
                else append_little_endian(data_, static_cast<std::uint16_t>(std::lrint(65535 * linear)));
            }
            data_.resize(end);
        });
    }

    /// Adds a node and a mesh for each part, all with the same vertices.
    void add_parts() {
        const std::vector<int> parts = parts_that_keep_apart(mesh_, stored_as_floats(mesh_, frame_));
        std::vector<std::vector<int>> corners(1 + at(std::max(0, *std::ranges::max_element(parts))));
        for (const int v : mesh_.F.reshaped<Eigen::RowMajor>()) corners[at(parts[at(v)])].push_back(v);
        for (const std::vector<int>& part : corners) {
            const OrderedJson description{{"componentType", unsigned_int}, {"count", part.size()}, {"type", "SCALAR"}};
            const std::size_t indices = accessor(description, {{"target", index_data}}, [&] {
                for (const int v : part) append_uint32(data_, at(v));
            });
            nodes_.push_back(frame_.node(meshes_.size()));
            meshes_.push_back({{"primitives", {{{"attributes", attributes_}, {"indices", indices}}}}});
        }
    }

    std::string bytes() {
        OrderedJson shown = OrderedJson::array();
        for (std::size_t node = 0; node < nodes_.size(); ++node) shown.push_back(node);
        const OrderedJson json{{"asset", {{"version", "2.0"}, {"generator", "meshfolio"}}},
                               {"scene", 0},
                               {"scenes", {{{"nodes", shown}}}},
                               {"nodes", nodes_},
                               {"meshes", meshes_},
                               {"buffers", {{{"byteLength", data_.size()}}}},
                               {"bufferViews", views_},
                               {"accessors", accessors_}};
        return glb_container(json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace), std::move(data_));
    }

private:
    float stored(double x, int axis) const { return finite(frame_.stored(x, axis)); }

    /// Adds an accessor of the data that `write` appends. Returns its index.
    template <class Write> std::size_t accessor(OrderedJson description, OrderedJson view, const Write& write) {
        view.update({{"buffer", 0}, {"byteOffset", data_.size()}});
        write();
        view["byteLength"] = data_.size() - view["byteOffset"].get<std::size_t>();
        description["bufferView"] = views_.size();
        views_.push_back(std::move(view));
        accessors_.push_back(std::move(description));
        return accessors_.size() - 1;
    }

    /// Adds an attribute: write(v) appends `row` bytes for vertex v.
    template <class Write> void attribute(const std::string& name, OrderedJson description, std::size_t row, const Write& write) {
        description["count"] = mesh_.X.rows();
        attributes_[name] = accessor(std::move(description), {{"byteStride", row}, {"target", vertex_data}}, [&] {
            for (Eigen::Index v = 0; v < mesh_.X.rows(); ++v) write(v);
        });
    }

    const TriangleMesh& mesh_;
    GlbFrame frame_;
    OrderedJson views_ = OrderedJson::array(), accessors_ = OrderedJson::array(), attributes_ = OrderedJson::object(),
                nodes_ = OrderedJson::array(), meshes_ = OrderedJson::array();
    std::string data_;
};

}   // namespace

bool is_gltf_color(ColumnGroup group) {
    const ScalarType type = group.front().type;
    if (group.size() < 3 || group.size() > 4 || group.front().name != "red") return false;
    if (type != ScalarType::float32) return type == ScalarType::uint8 || type == ScalarType::uint16;
    return std::ranges::all_of(group, [](const VertexColumn& channel) {
        return std::ranges::all_of(channel.values, [](double x) { return std::isnan(x) || (x >= 0 && x <= 1); });
    });
}

std::string glb_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns) {
    GlbWriter glb(mesh);
    glb.add_positions();
    for (const ColumnGroup group : groups_of(columns)) {
        if (group.front().name == "nx") continue;   // viewers compute them
        if (is_gltf_color(group)) glb.add_color(group);
        else if (group.size() <= 4 && !group.front().array.empty()) glb.add_values(group.front().array, group);
        else
            for (std::size_t i = 0; i < group.size(); ++i) glb.add_values(group[i].name, group.subspan(i, 1));
    }
    glb.add_parts();
    return glb.bytes();
}

std::string glb_container(std::string json, std::string data) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append_uint32(bytes, 2);
    append_uint32(bytes, 28 + json.size() + data.size());
    append_uint32(bytes, json.size());
    bytes += "JSON" + json;
    append_uint32(bytes, data.size());
    return bytes.append("BIN\0", 4) + data;
}

}   // namespace meshfolio
