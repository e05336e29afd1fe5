#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "base/at.h"
#include "mesh/io/mesh_encoders.h"

namespace meshfolio {

namespace {

using Group = std::span<const VertexColumn>;

/// Neighbours of one type make a group: the columns of an array; red, green, blue and perhaps alpha; nx, ny, nz. Others stand alone.
std::vector<Group> groups_of(const std::vector<VertexColumn>& columns) {
    static constexpr std::array<std::string_view, 4> rgba{"red", "green", "blue", "alpha"};
    static constexpr std::array<std::string_view, 3> normal{"nx", "ny", "nz"};
    const auto fits = [](Group left, std::span<const std::string_view> names) {
        return left.size() >= names.size() && std::ranges::equal(left.first(names.size()), names, [&](const VertexColumn& c, auto name) {
                   return c.name == name && c.type == left.front().type;
               });
    };
    const auto of_array = [](Group left) {
        const auto differs = [&](const VertexColumn& c) { return c.array != left.front().array || c.type != left.front().type; };
        return left.front().array.empty() ? 0 : static_cast<std::size_t>(std::ranges::find_if(left, differs) - left.begin());
    };
    std::vector<Group> groups;
    for (Group left(columns); !left.empty(); left = left.subspan(groups.back().size())) {
        const std::size_t named = fits(left, rgba) ? 4 : fits(left, std::span(rgba).first(3)) || fits(left, normal) ? 3 : 1;
        groups.push_back(left.first(std::max(named, of_array(left))));
    }
    return groups;
}

std::string escaped(const std::string& name) {
    std::string text;
    for (const char c : name) text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
    return text;
}

constexpr const char* vtk_types[] = {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Float32", "Float64"};

struct VtpWriter {
    std::string xml, data;

    /// value(i): of entry i / components, component i % components.
    template <class Value>
    void array(ScalarType type, const std::string& name, int components, int entries, const Value& value) {
        xml += std::string("<DataArray type=\"") + vtk_types[static_cast<int>(type)] + "\" Name=\"" + escaped(name) +
               "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(data.size()) +
               "\"/>\n";
        const std::size_t count = at(entries) * at(components);
        with_zero_of(type, [&](auto zero) {
            append_little_endian(data, std::uint64_t{count * sizeof(zero)});
            for (std::size_t i = 0; i < count; ++i) append_little_endian(data, static_cast<decltype(zero)>(value(i)));
        });
    }
};

using Json = nlohmann::ordered_json;

/// The lists of a file of glTF, and its data.
struct GlbWriter {
    Json views = Json::array(), accessors = Json::array(), attributes = Json::object();
    std::string data;

    /// What `write` appends. @return its number
    template <class Write>
    std::size_t accessor(Json description, Json view, const Write& write) {
        view.update({{"buffer", 0}, {"byteOffset", data.size()}});
        write();
        view["byteLength"] = data.size() - view["byteOffset"].get<std::size_t>();
        description["bufferView"] = views.size();
        views.push_back(std::move(view));
        accessors.push_back(std::move(description));
        return accessors.size() - 1;
    }
};

/// As near as a float of glTF comes, which is neither NaN nor infinite.
double finite(double x) {
    constexpr double largest = std::numeric_limits<float>::max();
    return std::isnan(x) ? 0 : std::clamp(x, -largest, largest);
}

/// Rows of a colour begin at multiples of four bytes.
void add_color(GlbWriter& glb, Group channels, Eigen::Index vertices) {
    const ScalarType type = channels.front().type;
    const std::size_t row = (channels.size() * size_of(type) + 3) / 4 * 4;
    const int code = type == ScalarType::uint8 ? 5121 : type == ScalarType::uint16 ? 5123 : 5126;
    const Json description{
        {"componentType", code}, {"normalized", is_integer(type)}, {"count", vertices}, {"type", channels.size() == 4 ? "VEC4" : "VEC3"}};
    glb.attributes["COLOR_0"] = glb.accessor(description, {{"byteStride", row}, {"target", 34962}}, [&] {
        for (Eigen::Index v = 0; v < vertices; ++v) {
            const std::size_t end = glb.data.size() + row;
            for (const VertexColumn& channel : channels)
                with_zero_of(type,
                             [&](auto zero) { append_little_endian(glb.data, static_cast<decltype(zero)>(finite(channel.values[v]))); });
            glb.data.resize(end);
        }
    });
}

void append_uint32(std::string& bytes, std::size_t number) { append_little_endian(bytes, static_cast<std::uint32_t>(number)); }

}   // namespace

std::string vtp_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns) {
    const int n = mesh.vertex_count(), m = mesh.face_count();
    VtpWriter vtp;
    vtp.xml =
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece "
        "NumberOfPoints=\"" +
        std::to_string(n) + "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(m) +
        "\">\n<PointData>\n";
    for (const Group group : groups_of(columns)) {
        const std::size_t size = group.size();
        const VertexColumn& front = group.front();
        const std::string name = size == 1              ? front.name
                                 : !front.array.empty() ? front.array
                                 : front.name == "nx"   ? "Normals"
                                 : size == 3            ? "RGB"
                                                        : "RGBA";
        vtp.array(group.front().type, name, static_cast<int>(size), n,
                  [&](std::size_t i) { return group[i % size].values[static_cast<Eigen::Index>(i / size)]; });
    }
    vtp.xml += "</PointData>\n<Points>\n";
    vtp.array(ScalarType::float64, "Points", 3, n, [&](std::size_t i) { return mesh.X.data()[i]; });
    vtp.xml += "</Points>\n<Polys>\n";
    vtp.array(ScalarType::int32, "connectivity", 1, 3 * m, [&](std::size_t i) { return mesh.F.data()[i]; });
    vtp.array(ScalarType::int32, "offsets", 1, m, [&](std::size_t i) { return 3 * i + 3; });
    vtp.xml += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    return vtp.xml + vtp.data + "\n</AppendedData>\n</VTKFile>\n";
}

std::string glb_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns) {
    const Eigen::Index n = mesh.vertex_count();
    const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> X = mesh.X.cast<float>();
    const Eigen::RowVector3f low = X.colwise().minCoeff(), high = X.colwise().maxCoeff();
    GlbWriter glb;
    const auto numbers = [&](const char* type, std::size_t code, Eigen::Index count) {
        return Json{{"componentType", code}, {"count", count}, {"type", type}};
    };
    Json positions = numbers("VEC3", 5126, n);
    positions.update({{"min", std::array{low[0], low[1], low[2]}}, {"max", std::array{high[0], high[1], high[2]}}});
    glb.attributes["POSITION"] = glb.accessor(positions, {{"target", 34962}}, [&] {
        for (const float x : X.reshaped<Eigen::RowMajor>()) append_little_endian(glb.data, x);
    });
    static constexpr std::array shapes{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto add_values = [&](const std::string& name, Group group) {
        glb.attributes["_" + name] = glb.accessor(numbers(shapes[group.size() - 1], 5126, n), {{"target", 34962}}, [&] {
            for (Eigen::Index v = 0; v < n; ++v)
                for (const VertexColumn& column : group) append_little_endian(glb.data, static_cast<float>(finite(column.values[v])));
        });
    };
    for (const Group group : groups_of(columns)) {
        const ScalarType type = group.front().type;
        if (group.front().name == "nx") continue;   // viewers compute them
        const bool is_color = group.size() > 1 && group.front().name == "red";
        if (is_color && (type == ScalarType::uint8 || type == ScalarType::uint16 || type == ScalarType::float32))
            add_color(glb, group, n);
        else if (group.size() <= shapes.size() && !group.front().array.empty())
            add_values(group.front().array, group);
        else
            for (std::size_t i = 0; i < group.size(); ++i) add_values(group[i].name, group.subspan(i, 1));
    }
    const std::size_t indices = glb.accessor(numbers("SCALAR", 5125, mesh.F.size()), {{"target", 34963}}, [&] {
        for (const int v : mesh.F.reshaped<Eigen::RowMajor>()) append_uint32(glb.data, at(v));
    });
    const Json json{{"asset", {{"version", "2.0"}, {"generator", "meshfolio"}}},
                    {"scene", 0},
                    {"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"mesh", 0}}}},
                    {"meshes", {{{"primitives", {{{"attributes", glb.attributes}, {"indices", indices}}}}}}},
                    {"buffers", {{{"byteLength", glb.data.size()}}}},
                    {"bufferViews", glb.views},
                    {"accessors", glb.accessors}};
    return glb_container(json.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(glb.data));
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
