#include <algorithm>
#include <array>
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

/// Returns the text with a line for each vertex and then for each face.
std::string with_lines_of(const TriangleMesh& mesh, std::string text, const char* before_vertex, const char* before_face, int first_index) {
    for (int v = 0; v < mesh.vertex_count(); ++v)
        text += before_vertex + exact_text(mesh.X(v, 0)) + ' ' + exact_text(mesh.X(v, 1)) + ' ' + exact_text(mesh.X(v, 2)) + '\n';
    for (int t = 0; t < mesh.face_count(); ++t) {
        text += before_face;
        for (int k = 0; k < 3; ++k) text += std::to_string(mesh.F(t, k) + first_index) + (k < 2 ? ' ' : '\n');
    }
    return text;
}

/// Replaces normals among the columns by those of the mesh.
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

/// Writes binary PLY, little endian, coordinates as double.
std::string ply_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
                        "\nproperty double x\nproperty double y\nproperty double z\n";
    std::set<std::string> taken{"x", "y", "z"};
    std::size_t row = 24;
    for (const VertexColumn& column : columns) {
        std::string name = column.name;
        for (char& c : name) c = c > ' ' && c < 127 ? c : '_';
        while (name.empty() || !taken.insert(name).second) name += '_';
        bytes += "property " + std::string(ply_name_of(column.type)) + ' ' + name + '\n';
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

/// The two parts of a VTP file: descriptions of arrays, and their values.
struct VtpWriter {
    std::string xml, data;

    /// Adds an array; value(i) is component i % components of entry i / components.
    template <class Value>
    void array(ScalarType type, const std::string& name, int components, int entries, const Value& value) {
        xml.append("<DataArray type=\"").append(vtk_type_names[static_cast<std::size_t>(type)]).append("\" Name=\"");
        for (const char c : name) xml += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
        xml += "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(data.size()) +
               "\"/>\n";
        const std::size_t count = at(entries) * at(components);
        with_zero_of(type, [&](auto zero) {
            append_little_endian(data, std::uint64_t{count * sizeof(zero)});
            for (std::size_t i = 0; i < count; ++i) append_little_endian(data, static_cast<decltype(zero)>(value(i)));
        });
    }
};

/// Writes PolyData of VTK in XML, its arrays appended as raw data, coordinates as double. Colours and normals are arrays of components.
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
        vtp.array(front.type, name, static_cast<int>(size), n,
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

}   // namespace

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

std::string encode_mesh(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.X.row(v).allFinite())
            throw MeshError("vertex " + std::to_string(v) + " is not finite", "such a mesh is not written", {file, 0});
        if (mesh.X.row(v).cwiseAbs().maxCoeff() > largest_coordinate)
            throw MeshError("vertex " + std::to_string(v) + " has a coordinate beyond 1e100", "no reader of ours would take it", {file, 0});
    }
    const std::string ending = file == "-" ? ".obj" : lower_case_ending(file);
    if (ending == ".obj") return attributes.obj.empty() ? with_lines_of(mesh, "", "v ", "f ", 1) : obj_with_positions(attributes, mesh);
    if (ending == ".off") {
        const std::string counts = std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count());
        return with_lines_of(mesh, "OFF\n" + counts + " 0\n", "", "3 ", 0);
    }
    if (ending == ".ply") return ply_bytes(mesh, with_normals_of(mesh, attributes.columns));
    if (ending == ".vtp") return vtp_bytes(mesh, with_normals_of(mesh, attributes.columns));
    if (ending == ".stl") return stl_bytes(mesh, file);
    if (ending == ".glb") return glb_bytes(mesh, attributes.columns);
    throw UsageError("cannot write a mesh as '" + ending + "'", "name the file .obj, .off, .ply, .stl, .vtp or .glb", {file, 0});
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) { write_file(path, encode_mesh(mesh, path.string())); }

}   // namespace meshfolio
