#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"

namespace meshfolio {

namespace {

using Json = nlohmann::json;

/// Reader of binary glTF 2.0 whose data is all in its own chunk (Khronos, "glTF 2.0 Specification", 2021): the triangles of its scene, each
/// node where its transformations put it. A vertex that is there once for each of its normals or texture coordinates is welded.
class GlbReader {
public:
    GlbReader(std::string_view bytes, const std::string& file, Keep keep) : file_(file), keeps_columns_(keep == Keep::attributes) {
        if (bytes.size() < 20 || !bytes.starts_with("glTF")) fail("no header of binary glTF", "the file may be cut off");
        const auto version = word(bytes, 4);
        if (version != 2) fail("glTF version " + std::to_string(version) + " is not supported", "export it as glTF 2.0");
        const std::size_t size = word(bytes, 8);
        if (size > bytes.size() || size < 20) fail("ends early (byte " + std::to_string(bytes.size()) + ")", "the file may be cut off");
        if (size < bytes.size()) warnings_.add(0, "bytes after the end ignored", "bytes after the end ignored");
        most_ = std::clamp<std::size_t>(size, 1000000, most_triangles);
        bytes = bytes.substr(12, size - 12);
        const std::string_view text = take_chunk(bytes, "JSON");
        if (!bytes.empty()) data_ = take_chunk(bytes, {"BIN\0", 4});
        json_ = Json::parse(text);
    }

    LoadedMesh run() {
        for (const Json& extension : json_.value("extensionsRequired", Json::array())) refuse_unknown(extension.get<std::string>());
        place_scene();
        if (corners_.empty()) fail("no triangles", "export the mesh with its faces");
        if (keeps_columns_ && !not_kept_.empty())
            warnings_.add(0, "attributes that are not kept", "attributes that are not kept",
                          joined({not_kept_.begin(), not_kept_.end()}, ", "));
        WeldedMesh mesh = welded(points_, corners_, {}, file_, warnings_);
        for (const Column& column : columns_) {
            if (column.values.size() != points_.size()) continue;   // not everywhere
            Vector kept(mesh.loaded.mesh.vertex_count());
            for (int v = 0; v < kept.size(); ++v) kept[v] = column.values[at(mesh.first[at(v)])];
            mesh.loaded.attributes.columns.push_back({column.name, std::move(kept), column.type, column.array});
        }
        return std::move(mesh.loaded);
    }

private:
    struct Accessor {
        const char* data;
        std::size_t count, stride;
        ScalarType type;
        int components;
        bool normalized;

        double operator()(std::size_t i, int k) const {
            return with_zero_of(type, [&](auto zero) {
                using T = decltype(zero);
                const auto value = static_cast<double>(little_endian<T>(data + i * stride + at(k) * sizeof(T)));
                return normalized ? std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : value;
            });
        }
    };

    struct Column {
        std::string name;
        ScalarType type;
        std::vector<double> values;   // of points
        std::string array;            // of several numbers
    };

    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const { throw InputError({file_, 0}, problem, remedy); }

    [[noreturn]] void damaged(const std::string& problem) const { fail(problem, "the file may be damaged"); }
    static std::uint32_t word(std::string_view bytes, std::size_t at) { return little_endian<std::uint32_t>(bytes.data() + at); }

    std::string_view take_chunk(std::string_view& bytes, std::string_view type) const {
        if (bytes.size() < 8 || word(bytes, 0) > bytes.size() - 8) fail("ends early within a chunk", "the file may be cut off");
        if (bytes.substr(4, 4) != type) damaged("the chunks are not JSON and BIN");
        const std::string_view chunk = bytes.substr(8, word(bytes, 0));
        bytes.remove_prefix(8 + chunk.size());
        return chunk;
    }

    /// What changes looks only may be required.
    void refuse_unknown(const std::string& extension) const {
        static constexpr std::array harmless{"KHR_mesh_quantization", "KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"};
        if (std::ranges::none_of(harmless, [&](const char* begin) { return extension.starts_with(begin); }))
            fail("needs the extension " + in_quotes(extension), "export it without compression or extensions");
    }

    /// A whole number of an object, from 0; `otherwise` where it is not there.
    std::size_t number(const Json& object, const char* key, std::size_t otherwise) const {
        const auto found = object.find(key);
        if (found == object.end()) return otherwise;
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
            damaged(std::string(key) + " is no whole number");
        return found->get<std::size_t>();
    }

    /// Entry `index` of one of the lists at the top.
    const Json& entry(const char* list, std::size_t index) const {
        const auto found = json_.find(list);
        if (found == json_.end() || !found->is_array() || index >= found->size())
            damaged("no entry " + std::to_string(index) + " of " + list);
        return (*found)[index];
    }

    Accessor accessor(std::size_t index) const {
        const Json& json = entry("accessors", index);
        const std::string name = "accessor " + std::to_string(index);
        if (json.contains("sparse")) fail(name + " is sparse, which is not supported", "export the mesh without morph targets");
        if (!json.contains("bufferView")) fail(name + " has no data", "export it without compression");
        static const std::map<std::size_t, ScalarType> types{{5120, ScalarType::int8},   {5121, ScalarType::uint8},
                                                             {5122, ScalarType::int16},  {5123, ScalarType::uint16},
                                                             {5125, ScalarType::uint32}, {5126, ScalarType::float32}};
        static const std::map<std::string, int> shapes{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
        const auto type = types.find(number(json, "componentType", 0));
        const auto shape = shapes.find(json.value("type", ""));
        if (type == types.end() || shape == shapes.end()) damaged(name + " is of a type that is not supported");
        const Json& view = entry("bufferViews", number(json, "bufferView", 0));
        const std::size_t buffer = number(view, "buffer", 0);
        if (buffer > 0 || entry("buffers", buffer).contains("uri"))
            fail(name + " is in another file or in text", "export it as GLB with all data embedded");
        const std::size_t element = size_of(type->second) * at(shape->second);
        const bool normalized = json.value("normalized", false) && is_integer(type->second);
        Accessor made{nullptr, number(json, "count", 0), number(view, "byteStride", element), type->second, shape->second, normalized};
        const std::size_t begin = number(view, "byteOffset", 0), length = number(view, "byteLength", 0),
                          offset = number(json, "byteOffset", 0);
        if (made.count == 0 || made.stride < element || made.stride > 255 || begin + length > data_.size() ||
            offset + (made.count - 1) * made.stride + element > length)
            fail(name + " reaches beyond its data", "the file may be cut off");
        made.data = data_.data() + begin + offset;
        return made;
    }

    void place_scene() {
        std::vector<std::pair<std::size_t, Eigen::Matrix4d>> places;   // nodes, and their parents' transformations
        const auto put = [&](const Json& of, const char* key, const Eigen::Matrix4d& parent) {   // the first one at the end
            const auto before = static_cast<std::ptrdiff_t>(places.size());
            for (const Json& node : of.value(key, Json::array())) places.emplace_back(node.get<std::size_t>(), parent);
            std::reverse(places.begin() + before, places.end());
        };
        put(entry("scenes", number(json_, "scene", 0)), "nodes", Eigen::Matrix4d::Identity());
        std::vector<char> is_placed(json_.value("nodes", Json::array()).size(), 0);
        while (!places.empty()) {
            const auto [number_of_node, parent] = places.back();
            places.pop_back();
            const Json& node = entry("nodes", number_of_node);
            if (std::exchange(is_placed[number_of_node], 1) != 0) damaged("node " + std::to_string(number_of_node) + " has two parents");
            const Eigen::Matrix4d matrix = parent * matrix_of(node);
            if (node.contains("skin"))
                warnings_.add(0, "skin ignored: the shape is that at rest", "skins ignored: their shapes are those at rest");
            if (node.contains("mesh")) place_mesh(entry("meshes", number(node, "mesh", 0)), matrix);
            put(node, "children", matrix);
        }
    }

    static Eigen::Matrix4d matrix_of(const Json& node) {
        const auto numbers = [&](const char* key, const auto& otherwise) {
            return node.contains(key) ? node.at(key).template get<std::decay_t<decltype(otherwise)>>() : otherwise;
        };
        if (node.contains("matrix")) return Eigen::Map<const Eigen::Matrix4d>(numbers("matrix", std::array<double, 16>{}).data());
        const auto move = numbers("translation", std::array{0.0, 0.0, 0.0}), size = numbers("scale", std::array{1.0, 1.0, 1.0});
        const auto turn = numbers("rotation", std::array{0.0, 0.0, 0.0, 1.0});
        Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
        matrix.topLeftCorner<3, 3>() = Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]).normalized().toRotationMatrix() *
                                       Eigen::Map<const Vector3>(size.data()).asDiagonal();
        matrix.topRightCorner<3, 1>() = Eigen::Map<const Vector3>(move.data());
        return matrix;
    }

    void place_mesh(const Json& mesh, const Eigen::Matrix4d& matrix) {
        std::map<std::size_t, int> first_points;   // of accessors: what shares positions shares vertices
        for (const Json& primitive : mesh.at("primitives")) {
            const std::size_t mode = number(primitive, "mode", 4);
            if (mode < 4 || mode > 6) {
                warnings_.add(0, "points or lines ignored", "sets of points or lines ignored");
                continue;
            }
            if (primitive.contains("targets"))
                warnings_.add(0, "morph targets ignored", "primitives with morph targets, which are ignored");
            for (const auto& [name, index] : primitive.at("attributes").items())
                if (name != "POSITION" && name != "NORMAL" && !is_column(name)) not_kept_.insert(name);
            if (primitive.contains("material")) not_kept_.insert("material");
            const std::size_t positions = number(primitive.at("attributes"), "POSITION", std::size_t{1} << 40);
            const auto [place, is_new] = first_points.try_emplace(positions, static_cast<int>(points_.size()));
            const Accessor points = accessor(positions);
            if (is_new) add_points(points, primitive.at("attributes"), matrix);
            add_triangles(corners_of(primitive, points.count), mode, place->second, matrix.topLeftCorner<3, 3>().determinant() < 0);
        }
    }

    void refuse_too_many(std::size_t count) const {
        if (count > most_)
            fail("its instances make more than " + std::to_string(most_) + " vertices, values or triangles", "export one of each mesh");
    }

    void add_points(const Accessor& points, const Json& attributes, const Eigen::Matrix4d& matrix) {
        if (points.components != 3) damaged("positions are not VEC3");
        const std::size_t before = points_.size();
        refuse_too_many(before + points.count);
        for (std::size_t i = 0; i < points.count; ++i) {
            const Eigen::Vector4d x = matrix * Eigen::Vector4d(points(i, 0), points(i, 1), points(i, 2), 1);
            if (!(x.head<3>().cwiseAbs().array() <= largest_coordinate).all())
                fail("vertex " + std::to_string(i) + ": coordinate is not finite or out of the supported range (1e100)",
                     "every coordinate must be finite");
            points_.push_back({x[0], x[1], x[2]});
        }
        if (!keeps_columns_) return;
        for (const auto& [name, index] : attributes.items()) {
            if (!is_column(name)) continue;
            const Accessor values = accessor(index.get<std::size_t>());
            refuse_too_many(column_values_ += values.count * at(values.components));
            if (values.count != points.count) damaged(name + " has another count than the positions");
            add_columns(name, values, before);
        }
    }

    static bool is_column(const std::string& attribute) { return attribute == "COLOR_0" || attribute.starts_with('_'); }

    /// A colour's channels as they are stored; of an attribute of one's own, its components.
    void add_columns(const std::string& name, Accessor values, std::size_t before) {
        static constexpr std::array channels{"red", "green", "blue", "alpha"};
        values.normalized = false;
        const bool is_color = name == "COLOR_0", is_alone = values.components == 1;
        const std::string own = name.substr(1), array = is_color || is_alone ? "" : own;
        for (int k = 0; k < values.components; ++k) {
            const std::string component = is_color ? channels[at(k)] : is_alone ? own : component_name(own, at(k), at(values.components));
            auto column = std::ranges::find(columns_, component, &Column::name);
            if (column == columns_.end()) column = columns_.insert(column, {component, values.type, {}, array});
            if (column->values.size() != before || column->type != values.type) continue;   // not everywhere
            for (std::size_t i = 0; i < values.count; ++i) column->values.push_back(values(i, k));
        }
    }

    /// Of the triangles, in the order of the primitive.
    std::vector<int> corners_of(const Json& primitive, std::size_t points) const {
        std::vector<int> corners(primitive.contains("indices") ? 0 : points);
        std::iota(corners.begin(), corners.end(), 0);
        if (!corners.empty()) return corners;
        const Accessor indices = accessor(number(primitive, "indices", 0));
        if (indices.components != 1 || !is_integer(indices.type)) damaged("indices are no whole numbers");
        refuse_too_many(corners_.size() / 3 + indices.count / 3);
        for (std::size_t i = 0; i < indices.count; ++i) {
            const double index = indices(i, 0);
            if (!(index >= 0 && index < static_cast<double>(points)))
                damaged("index " + std::to_string(static_cast<long long>(index)) + " out of range (" + std::to_string(points) +
                        " vertices)");
            corners.push_back(static_cast<int>(index));
        }
        return corners;
    }

    /// Independent ones (mode 4), a strip whose every second one is turned (5), or a fan (6).
    void add_triangles(const std::vector<int>& corners, std::size_t mode, int first, bool turned) {
        if (mode == 4 && corners.size() % 3 != 0) damaged("the number of corners is no multiple of 3");
        const std::size_t step = mode == 4 ? 3 : 1;
        refuse_too_many(corners_.size() / 3 + corners.size() / step);
        for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
            std::array<int, 3> triangle{corners[mode == 6 ? 0 : i], corners[i + 1], corners[i + 2]};
            if ((mode == 5 && i % 2 == 1) != turned) std::swap(triangle[0], triangle[1]);
            for (const int corner : triangle) corners_.push_back(first + corner);
        }
    }

    const std::string& file_;
    bool keeps_columns_;
    std::size_t most_ = 0;   // of points and of triangles: instances may multiply what a small file has
    Json json_;
    std::string_view data_;
    WarningTally warnings_;
    std::vector<std::array<double, 3>> points_;
    std::vector<int> corners_;   // of triangles, as numbers of points
    std::vector<Column> columns_;
    std::size_t column_values_ = 0;
    std::set<std::string> not_kept_;
};

}   // namespace

LoadedMesh parse_glb(std::string_view bytes, const std::string& file, Keep keep) try {
    return GlbReader(bytes, file, keep).run();
} catch (const Json::exception& error) {
    throw InputError({file, 0}, "no valid glTF: " + in_quotes(error.what(), 160), "the file may be damaged");
}

}   // namespace meshfolio
