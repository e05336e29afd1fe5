#include "output/draw/write_glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "color/srgb.h"
#include "draw_mesh.h"
#include "mesh/io/glb/glb_parts.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/triangle_measures.h"
#include "output/draw/surface_of.h"

namespace meshfolio::output {

namespace {

using Json = nlohmann::ordered_json;

/// Constants of glTF.
enum Component { byte_type = 5120, unsigned_byte = 5121, unsigned_short = 5123, unsigned_int = 5125, float_type = 5126 };
enum Target { vertex_data = 34962, index_data = 34963 };
constexpr int grid_steps = 65535;           // over the largest side of the box
constexpr int most_short_indices = 65535;   // the last short number means "restart"

/// Appends the lowest `size` bytes of a number, little endian.
void put(std::string& bytes, std::uint32_t number, int size) {
    for (int k = 0; k < size; ++k) bytes += static_cast<char>(number >> (8 * k) & 255);
}

void pad(std::string& bytes) {
    while (bytes.size() % 4 != 0) bytes += '\0';
}

/// Builds the binary chunk and its description.
class Writer {
public:
    explicit Writer(const TriangleMesh& mesh) : mesh_(mesh), count_(mesh.vertex_count()) {}

    void write_indices() {
        const bool is_short = count_ <= most_short_indices;
        const Json description{{"componentType", is_short ? unsigned_short : unsigned_int}, {"count", mesh_.F.size()}, {"type", "SCALAR"}};
        indices_ = accessor(index_data, description, [&] {
            for (const int v : mesh_.F.reshaped<Eigen::RowMajor>()) put(bytes_, static_cast<std::uint32_t>(v), is_short ? 2 : 4);
        });
    }

    /// Writes the positions as steps of the grid. Vertices outside of it, which no triangle uses, go to its border.
    void write_positions(const GlbFrame& grid) {
        std::array<std::uint32_t, 3> low{grid_steps, grid_steps, grid_steps}, high{0, 0, 0};
        attribute("POSITION", {{"componentType", unsigned_short}, {"count", count_}, {"type", "VEC3"}}, [&](int v) {
            for (int k = 0; k < 3; ++k) {
                const auto step =
                    static_cast<std::uint32_t>(std::lrint(std::clamp(grid.stored(mesh_.X(v, k), k), 0.0, double(grid_steps))));
                low[at(k)] = std::min(low[at(k)], step);
                high[at(k)] = std::max(high[at(k)], step);
                put(bytes_, step, 2);
            }
        });
        accessors_.back().update(Json{{"min", low}, {"max", high}});
    }

    void write_normals() {
        const Positions normals = vertex_normals(mesh_);
        attribute("NORMAL", {{"componentType", byte_type}, {"normalized", true}, {"count", count_}, {"type", "VEC3"}}, [&](int v) {
            // The format wants a normal even at a vertex without area.
            const Vector3 n = normals.row(v).isZero() ? Vector3(0, 0, 1) : Vector3(normals.row(v));
            for (int k = 0; k < 3; ++k) put(bytes_, static_cast<std::uint32_t>(std::lrint(127 * n[k])), 1);
        });
    }

    /// Writes the values, their colours and, if some are undefined, the mask.
    void write_values(const Vector& values, const render::ValueRange& range, render::Rgba undefined) {
        attribute("COLOR_0", {{"componentType", unsigned_short}, {"normalized", true}, {"count", count_}, {"type", "VEC3"}}, [&](int v) {
            const render::Rgba c = std::isnan(values[v]) ? undefined : render::color_at(*range.colormap, range.position(values[v]));
            for (const std::uint8_t channel : {c.r, c.g, c.b})
                put(bytes_, static_cast<std::uint32_t>(std::lrint(65535 * double(render::linear_of(channel)))), 2);
        });
        attribute("_VALUE", {{"componentType", float_type}, {"count", count_}, {"type", "SCALAR"}}, [&](int v) {
            constexpr double largest = std::numeric_limits<float>::max();
            const double value = std::isnan(values[v]) ? 0 : std::clamp(values[v], -largest, largest);
            put(bytes_, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
        });
        if (values.array().isNaN().any())
            attribute("_DEFINED", {{"componentType", unsigned_byte}, {"count", count_}, {"type", "SCALAR"}},
                      [&](int v) { put(bytes_, std::isnan(values[v]) ? 0 : 1, 4); });
    }

    /// Returns the file. @param json  all but the buffers and what refers to them
    std::string glb(Json json) {
        json["meshes"][0]["primitives"] = Json::array({{{"attributes", attributes_}, {"indices", indices_}, {"material", 0}, {"mode", 4}}});
        json["accessors"] = accessors_;
        json["bufferViews"] = views_;
        pad(bytes_);
        json["buffers"][0]["byteLength"] = bytes_.size();
        return glb_container(json.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(bytes_));
    }

private:
    /// Makes an accessor, with a view of its own, for what `write` appends. Returns its number.
    template <class Write> std::size_t accessor(Target target, const Json& description, const Write& write) {
        pad(bytes_);
        const std::size_t begin = bytes_.size();
        write();
        const std::size_t length = bytes_.size() - begin;
        views_.push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", length}});
        if (target == vertex_data) views_.back()["byteStride"] = length / static_cast<std::size_t>(count_);
        views_.back()["target"] = target;
        accessors_.push_back({{"bufferView", views_.size() - 1}});
        accessors_.back().update(description);
        return accessors_.size() - 1;
    }

    /// Makes an attribute: put_vertex(v) appends the bytes of vertex v, which are then padded.
    template <class PutVertex> void attribute(const char* name, const Json& description, const PutVertex& put_vertex) {
        attributes_[name] = accessor(vertex_data, description, [&] {
            for (int v = 0; v < count_; ++v) put_vertex(v), pad(bytes_);
        });
    }

    const TriangleMesh& mesh_;
    int count_;
    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array(), attributes_ = Json::object();
    std::size_t indices_ = 0;
};

Json extras_of_values(const ColorRange& range, bool has_undefined, render::Rgba undefined) {
    Json colors = Json::array();
    for (const render::Rgba& stop : value_range(range).colormap->stops) colors.push_back(hex_of(stop));
    return {{"attribute", "_VALUE"},
            {"quantity", range.quantity},
            {"unit", range.unit},
            {"range", {range.low, range.high}},
            {"logarithmic", range.logarithmic},
            {"colormap", range.colormap},
            {"colors", std::move(colors)},
            {"defined", has_undefined ? Json("_DEFINED") : Json()},
            {"undefined_color", hex_of(undefined)}};
}

/// Returns a matt, two-sided material, with the colour of the surface unless the vertices have colours.
Json material_of(bool colored, render::Rgba surface) {
    Json look{{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
    if (!colored) look["baseColorFactor"] = {render::linear_of(surface.r), render::linear_of(surface.g), render::linear_of(surface.b), 1.0};
    return {{"pbrMetallicRoughness", std::move(look)}, {"doubleSided", true}};
}

template <class V> Json json_of(const V& v) { return Json::array({v[0], v[1], v[2]}); }

}   // namespace

Ball ball_around(const TriangleMesh& mesh) {
    Ball ball{.centre = bounding_box(mesh).centre(), .radius = 0};
    for (const int v : mesh.F.reshaped()) ball.radius = std::max(ball.radius, (mesh.X.row(v).transpose() - ball.centre).norm());
    return ball;
}

bool can_be_a_model(const TriangleMesh& mesh) {
    if (mesh.face_count() == 0 || !mesh.X.allFinite()) return false;
    const double largest = bounding_box(mesh).extent().maxCoeff();
    return std::isfinite(largest) && largest / grid_steps > std::numeric_limits<double>::min();
}

std::string write_glb(const TriangleMesh& mesh, const Vector& values, const std::optional<ColorRange>& range, const Ball& frame) {
    if (!can_be_a_model(mesh))
        throw MeshError("cannot write a model: the mesh has no triangles of some extent, or coordinates that are not finite",
                        "take --glb away, or repair the mesh");
    if (range && values.size() != mesh.vertex_count())
        throw MeshError(
            "cannot write a model: " + std::to_string(values.size()) + " values for " + std::to_string(mesh.vertex_count()) + " vertices",
            "give one value for each vertex");
    const render::DrawOptions look;
    const Box box = bounding_box(mesh);
    const GlbFrame grid{box.low, box.extent().maxCoeff() / grid_steps};
    Writer writer(mesh);
    writer.write_indices();
    writer.write_positions(grid);
    writer.write_normals();
    Json extras = Json::object();
    if (range) {
        writer.write_values(values, value_range(*range), look.undefined_color);
        extras["value"] = extras_of_values(*range, values.array().isNaN().any(), look.undefined_color);
    }
    extras["frame"] = {
        {"centre", json_of(frame.centre)}, {"radius", frame.radius}, {"from", json_of(frame.view.from)}, {"up", json_of(frame.view.up)}};
    if (frame.zoom != 1) extras["frame"]["zoom"] = frame.zoom;
    Json json;
    json["asset"] = {{"version", "2.0"}, {"generator", "meshfolio"}};
    json["extensionsUsed"] = json["extensionsRequired"] = Json::array({"KHR_mesh_quantization"});
    json["scene"] = 0;
    json["scenes"][0]["nodes"] = Json::array({0});
    json["nodes"][0] = grid.node(0);
    json["materials"][0] = material_of(range.has_value(), look.surface_color);
    json["meshes"][0]["extras"] = std::move(extras);
    return writer.glb(std::move(json));
}

}   // namespace meshfolio::output
