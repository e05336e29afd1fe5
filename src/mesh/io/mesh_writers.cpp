#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "base/at.h"
#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "mesh/io/glb/glb_parts.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/ply_header.h"
#include "mesh/io/polygon_list.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// Returns `text` with a line added for each vertex and then for each face. @param first_index  number of vertex 0 in faces
std::string text_of(const TriangleMesh& mesh, std::string text, const char* before_vertex, const char* before_face, int first_index) {
    for (int v = 0; v < mesh.vertex_count(); ++v)
        text += before_vertex + exact_text(mesh.X(v, 0)) + ' ' + exact_text(mesh.X(v, 1)) + ' ' + exact_text(mesh.X(v, 2)) + '\n';
    for (int t = 0; t < mesh.face_count(); ++t) {
        text += before_face;
        for (int k = 0; k < 3; ++k) text += std::to_string(mesh.F(t, k) + first_index) + (k < 2 ? ' ' : '\n');
    }
    return text;
}

/// Returns the columns with nx, ny and nz, if they are there, replaced by the vertex normals of the mesh.
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

/// Returns a file of binary PLY, little endian, coordinates as double.
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
    template <class Value> void array(ScalarType type, const std::string& name, int components, int entries, const Value& value) {
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

/// Returns a file of PolyData of VTK in XML, its arrays appended as raw data, coordinates as double. Colours and normals are arrays of
/// components.
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

using Strings = std::vector<std::string>;

/// Returns "N values of a, b …" for each kind of value that a float of glTF does not hold.
Strings values_that_change(const Attributes& attributes) {
    struct Kind {
        bool (*is_met)(double);
        const char* message;
        long long count = 0;
        Strings names = {};
    };
    using Float = std::numeric_limits<float>;
    std::array kinds{Kind{[](double x) { return !std::isfinite(x); },
                          "are undefined or infinite, which glTF forbids: 0 or the largest float stands for them"},
                     Kind{[](double x) { return std::isfinite(x) && std::abs(x) > Float::max(); },
                          "are beyond the largest float (3.4e38), which stands for them"},
                     Kind{[](double x) { return x != 0 && std::abs(x) < Float::min() && static_cast<float>(x) != x; },
                          "are too small for a float (below 1.2e-38): 0 or a coarser value stands for them"},
                     Kind{[](double x) { return std::abs(x) <= 1LL << 53 && std::floor(x) == x && static_cast<float>(x) != x; },
                          "are whole numbers beyond those of a float, and rounded"}};
    Strings sentences;
    for (const ColumnGroup group : groups_of(attributes.columns)) {
        if (is_gltf_color(group)) {
            const auto without = std::ranges::count_if(group.front().values, [](double x) { return std::isnan(x); });
            if (without > 0) sentences.push_back(std::to_string(without) + " vertices have no colour, and are written as white");
            continue;
        }
        if (group.size() > 1 && group.front().name == "red")
            sentences.push_back("colours that are no floats between 0 and 1 are written as values (_red, _green, _blue), not as colours");
        for (const VertexColumn& column : group) {
            for (Kind& kind : kinds) {
                const auto count = std::ranges::count_if(column.values, kind.is_met);
                if (count > 0 && !is_normal(column)) kind.names.push_back(column.name);
                kind.count += is_normal(column) ? 0 : count;
            }
        }
    }
    for (const Kind& kind : kinds)
        if (kind.count > 0)
            sentences.push_back(std::to_string(kind.count) + " values of " + first_of_many(kind.names) + " " + kind.message +
                                "; PLY and VTP keep them");
    return sentences;
}

/// Returns sentences on damage to the surface by rounding coordinates to floats, and by readers that weld vertices at one place.
Strings corners_that_move(const std::string& format, const TriangleMesh& mesh) {
    constexpr double least_cosine = 0.996;   // the cosine of 5°
    constexpr double least_share = 1e-3;     // of an edge: curvatures change by some per cent
    const bool is_glb = format == "GLB";
    const TriangleMesh rounded{stored_as_floats(mesh, is_glb ? float_frame(mesh) : GlbFrame()), mesh.F};
    const std::vector<int> whole = one_part(mesh), parts = is_glb ? parts_that_keep_apart(mesh, rounded.X) : whole;
    const Positions before = face_normals(mesh), after = face_normals(rounded);   // 0 where there is no area
    const Vector cosines = before.cwiseProduct(after).rowwise().sum();
    const auto turned_faces = (before.rowwise().squaredNorm().array() > 0 && cosines.array() < least_cosine).count();
    const int coincident = count_of_welded(mesh.X, whole), merged = count_of_welded(rounded.X, whole) - coincident;
    const int welded = std::min(coincident, count_of_welded(mesh.X, parts));
    const std::string of_vertices = " of " + std::to_string(mesh.vertex_count()) + " vertices ";
    Strings sentences;
    if (welded > 0)
        sentences.push_back(std::to_string(welded) + of_vertices + "lie where others do and are one with them when the " + format +
                            " file is read again; OBJ, OFF, PLY and VTP keep them apart");
    const double moved = (rounded.X - mesh.X).rowwise().norm().maxCoeff(), share = moved / mean_edge_length(mesh);
    if (turned_faces == 0 && merged == 0 && share > least_share)
        sentences.push_back("rounded to the floats of " + format + ", vertices move by up to " + plain_text(100 * share, 2) +
                            " % of the mean edge, and curvatures change; write OBJ, OFF, PLY or VTP, or move the mesh to the origin");
    if (turned_faces > 0 || merged > 0)
        sentences.push_back("rounded to the floats of " + format + ", " + std::to_string(merged) + of_vertices + "fall onto others and " +
                            std::to_string(turned_faces) + " of " + std::to_string(mesh.face_count()) +
                            " faces turn by 5 degrees or vanish; write OBJ, OFF, PLY or VTP, or move the mesh to the origin");
    return sentences;
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
            throw MeshError("vertex " + std::to_string(v) + " is not finite and cannot be written", "every coordinate must be a number",
                            {file, 0});
        if (mesh.X.row(v).cwiseAbs().maxCoeff() > largest_coordinate)
            throw MeshError("vertex " + std::to_string(v) + " has a coordinate beyond 1e100",
                            "scale the mesh down, or readers will refuse it", {file, 0});
    }
    const std::string ending = file == "-" ? ".obj" : lower_case_ending(file);
    if (ending == ".obj") return attributes.obj.empty() ? text_of(mesh, "", "v ", "f ", 1) : obj_with_positions(attributes, mesh);
    if (ending == ".off") {
        const std::string counts = std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count());
        return text_of(mesh, "OFF\n" + counts + " 0\n", "", "3 ", 0);
    }
    if (ending == ".ply") return ply_bytes(mesh, with_normals_of(mesh, attributes.columns));
    if (ending == ".vtp") return vtp_bytes(mesh, with_normals_of(mesh, attributes.columns));
    if (ending == ".stl") return stl_bytes(mesh, file);
    if (ending == ".glb") return glb_bytes(mesh, attributes.columns);
    throw UsageError("cannot write a mesh as '" + ending + "'", "name the file .obj, .off, .ply, .stl, .vtp or .glb", {file, 0});
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) { write_file(path, encode_mesh(mesh, path.string())); }

std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes) {
    const std::string ending = file == "-" ? ".obj" : lower_case_ending(file);
    std::string format = ending.substr(std::min<std::size_t>(1, ending.size()));
    std::ranges::transform(format, format.begin(), [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    const Strings holding = column_endings();
    const bool is_same_text = ending == ".obj" && !attributes.obj.empty();
    Strings found, names;
    for (const VertexColumn& column : attributes.columns)
        if (!is_normal(column)) names.push_back(column.name);
    if (!is_same_text && !names.empty() && std::ranges::find(holding, ending) == holding.end())
        found.push_back(format + " holds no values of vertices: not kept are " + first_of_many(names) + "; write PLY or VTP for them");
    if (ending != ".obj" && (attributes.obj.find("\nvt ") != std::string::npos || attributes.obj.find("\nusemtl ") != std::string::npos))
        found.push_back("texture coordinates, groups and materials are kept from OBJ to OBJ only");
    for (const Strings& more : {ending == ".glb" ? values_that_change(attributes) : Strings(),
                                ending == ".glb" || ending == ".stl" ? corners_that_move(format, mesh) : Strings()})
        found.insert(found.end(), more.begin(), more.end());
    return found;
}

}   // namespace meshfolio
