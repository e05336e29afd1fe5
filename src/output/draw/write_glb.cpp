#include "output/draw/write_glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

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
constexpr int grid_steps = 65535;           // of the largest side of the box
constexpr int most_short_indices = 65535;   // the last short number means "restart"

/// Little endian, whatever the machine is.
void put(std::string& bytes, std::uint32_t number, int size) {
    for (int k = 0; k < size; ++k) bytes += static_cast<char>(number >> (8 * k) & 255);
}

void pad(std::string& bytes) {
    while (bytes.size() % 4 != 0) bytes += '\0';
}

/// Steps over the box of the corners of triangles.
GlbFrame grid_of(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    return {box.low, box.extent().maxCoeff() / grid_steps};
}

/// The binary chunk and what describes it.
class Writer {
public:
    Writer(const TriangleMesh& mesh) : mesh_(mesh), count_(mesh.vertex_count()) {}

    void write_indices() {
        begin(index_data, 0);
        const bool is_short = count_ <= most_short_indices;
        for (const int v : mesh_.F.reshaped<Eigen::RowMajor>()) put(bytes_, static_cast<std::uint32_t>(v), is_short ? 2 : 4);
        indices_ = end({{"componentType", is_short ? unsigned_short : unsigned_int}, {"count", mesh_.F.size()}, {"type", "SCALAR"}});
    }

    /// Vertices outside of the grid, which no triangle uses, go to its border.
    void write_positions(const GlbFrame& grid) {
        std::array<std::uint32_t, 3> low{grid_steps, grid_steps, grid_steps}, high{0, 0, 0};
        begin(vertex_data, 8);
        for (int v = 0; v < count_; ++v) {
            for (int k = 0; k < 3; ++k) {
                const auto at = static_cast<std::uint32_t>(std::lrint(std::clamp(grid.stored(mesh_.X(v, k), k), 0.0, double(grid_steps))));
                low[static_cast<std::size_t>(k)] = std::min(low[static_cast<std::size_t>(k)], at);
                high[static_cast<std::size_t>(k)] = std::max(high[static_cast<std::size_t>(k)], at);
                put(bytes_, at, 2);
            }
            pad(bytes_);
        }
        attribute("POSITION", {{"componentType", unsigned_short}, {"count", count_}, {"type", "VEC3"}, {"min", low}, {"max", high}});
    }

    /// A vertex without area has no normal, but the format wants one.
    void write_normals() {
        begin(vertex_data, 4);
        const Positions normals = vertex_normals(mesh_);
        for (int v = 0; v < count_; ++v) {
            const Vector3 n = normals.row(v).isZero() ? Vector3(0, 0, 1) : Vector3(normals.row(v));
            for (int k = 0; k < 3; ++k) put(bytes_, static_cast<std::uint32_t>(std::lrint(127 * n[k])), 1);
            pad(bytes_);
        }
        attribute("NORMAL", {{"componentType", byte_type}, {"normalized", true}, {"count", count_}, {"type", "VEC3"}});
    }

    void write_colors(const Vector& values, const render::ValueRange& range, render::Rgba undefined) {
        begin(vertex_data, 8);
        for (const double value : values) {
            const render::Rgba c = std::isnan(value) ? undefined : render::color_at(*range.colormap, range.position(value));
            for (const std::uint8_t channel : {c.r, c.g, c.b})
                put(bytes_, static_cast<std::uint32_t>(std::lrint(65535 * double(render::linear_of(channel)))), 2);
            pad(bytes_);
        }
        attribute("COLOR_0", {{"componentType", unsigned_short}, {"normalized", true}, {"count", count_}, {"type", "VEC3"}});
    }

    void write_values(const Vector& values) {
        constexpr double largest = std::numeric_limits<float>::max();
        begin(vertex_data, 4);
        for (const double value : values)
            put(bytes_, std::bit_cast<std::uint32_t>(std::isnan(value) ? 0.0F : static_cast<float>(std::clamp(value, -largest, largest))),
                4);
        attribute("_VALUE", {{"componentType", float_type}, {"count", count_}, {"type", "SCALAR"}});
    }

    void write_mask(const Vector& values) {
        begin(vertex_data, 4);
        for (const double value : values) put(bytes_, std::isnan(value) ? 0 : 1, 4);
        attribute("_DEFINED", {{"componentType", unsigned_byte}, {"count", count_}, {"type", "SCALAR"}});
    }

    /// @param json  all but the buffers and what refers to them
    std::string glb(Json json) {
        json["meshes"][0]["primitives"] = Json::array({{{"attributes", attributes_}, {"indices", indices_}, {"material", 0}, {"mode", 4}}});
        json["accessors"] = accessors_;
        json["bufferViews"] = views_;
        pad(bytes_);
        json["buffers"][0]["byteLength"] = bytes_.size();
        return glb_container(json.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(bytes_));
    }

private:
    void begin(Target target, int stride) {
        pad(bytes_);
        views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", 0}});
        if (stride > 0) views_.back()["byteStride"] = stride;
        views_.back()["target"] = target;
    }

    std::size_t end(const Json& accessor) {
        views_.back()["byteLength"] = bytes_.size() - views_.back()["byteOffset"].get<std::size_t>();
        Json described;
        described["bufferView"] = views_.size() - 1;
        described.update(accessor);
        accessors_.push_back(std::move(described));
        return accessors_.size() - 1;
    }

    void attribute(const char* name, const Json& accessor) { attributes_[name] = end(accessor); }

    const TriangleMesh& mesh_;
    int count_;
    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array(), attributes_ = Json::object();
    std::size_t indices_ = 0;
};

std::array<double, 3> numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

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

/// Matt, two-sided; the colour of a surface without values.
Json material_of(bool colored, render::Rgba surface) {
    Json look{{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
    if (!colored) look["baseColorFactor"] = {render::linear_of(surface.r), render::linear_of(surface.g), render::linear_of(surface.b), 1.0};
    return {{"pbrMetallicRoughness", std::move(look)}, {"doubleSided", true}};
}

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
    if (!can_be_a_model(mesh)) throw MeshError("no model: needs triangles of some extent and finite coordinates");
    if (range && values.size() != mesh.vertex_count()) throw MeshError("no model: one value a vertex is needed");
    const render::DrawOptions look;
    const GlbFrame grid = grid_of(mesh);
    Writer writer(mesh);
    writer.write_indices();
    writer.write_positions(grid);
    writer.write_normals();
    Json extras = Json::object();
    if (range) {
        const bool has_undefined = values.array().isNaN().any();
        writer.write_colors(values, value_range(*range), look.undefined_color);
        writer.write_values(values);
        if (has_undefined) writer.write_mask(values);
        extras["value"] = extras_of_values(*range, has_undefined, look.undefined_color);
    }
    const auto axis = [](const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); };
    extras["frame"] = {
        {"centre", numbers(frame.centre)}, {"radius", frame.radius}, {"from", axis(frame.view.from)}, {"up", axis(frame.view.up)}};
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
