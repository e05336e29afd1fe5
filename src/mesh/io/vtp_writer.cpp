#include <algorithm>
#include <array>
#include <cstdint>

#include "base/at.h"
#include "mesh/io/column_groups.h"
#include "mesh/io/mesh_encoders.h"

namespace meshfolio {

std::vector<ColumnGroup> groups_of(const std::vector<VertexColumn>& columns) {
    static constexpr std::array<std::string_view, 4> rgba{"red", "green", "blue", "alpha"};
    static constexpr std::array<std::string_view, 3> normal{"nx", "ny", "nz"};
    const auto fits = [](ColumnGroup left, std::span<const std::string_view> names) {
        return left.size() >= names.size() && std::ranges::equal(left.first(names.size()), names, [&](const VertexColumn& c, auto name) {
                   return c.name == name && c.type == left.front().type;
               });
    };
    const auto of_array = [](ColumnGroup left) {
        const auto differs = [&](const VertexColumn& c) { return c.array != left.front().array || c.type != left.front().type; };
        return left.front().array.empty() ? 0 : static_cast<std::size_t>(std::ranges::find_if(left, differs) - left.begin());
    };
    std::vector<ColumnGroup> groups;
    for (ColumnGroup left(columns); !left.empty(); left = left.subspan(groups.back().size())) {
        const std::size_t named = fits(left, rgba) ? 4 : fits(left, std::span(rgba).first(3)) || fits(left, normal) ? 3 : 1;
        groups.push_back(left.first(std::max(named, of_array(left))));
    }
    return groups;
}

namespace {

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

}   // namespace

std::string vtp_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns) {
    const int n = mesh.vertex_count(), m = mesh.face_count();
    VtpWriter vtp;
    vtp.xml =
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece "
        "NumberOfPoints=\"" +
        std::to_string(n) + "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(m) +
        "\">\n<PointData>\n";
    for (const ColumnGroup group : groups_of(columns)) {
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

}   // namespace meshfolio
