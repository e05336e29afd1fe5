#include "mesh/io/ply_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/errors.h"
#include "base/large_pages.h"
#include "base/parallel.h"
#include "mesh/io/polygon_list.h"

namespace meshfolio {

namespace {

[[noreturn]] void fail(const std::string& file, long line, const std::string& problem, const std::string& remedy) {
    throw InputError({file, line}, problem, remedy);
}

const PlyElement* element_named(const PlyHeader& header, std::string_view name) {
    const auto e = std::find_if(header.elements.begin(), header.elements.end(), [&](auto& element) { return element.name == name; });
    return e == header.elements.end() ? nullptr : &*e;
}

/// Place of a property among those of its element; nothing when it has none of that name.
std::optional<std::size_t> property_named(const PlyElement& element, std::string_view name) {
    const auto p = std::find_if(element.properties.begin(), element.properties.end(), [&](auto& q) { return q.name == name; });
    if (p == element.properties.end()) return std::nullopt;
    return static_cast<std::size_t>(p - element.properties.begin());
}

/// Rows of one length, one after the other.
struct Rows {
    const char* first;
    std::size_t length;
    const char* row(int i) const { return first + static_cast<std::size_t>(i) * length; }
};

template <class T>
T value_at(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// Bytes of the properties before number `count` of an element, its list of corners taken to have three; nothing where another is a list.
std::optional<std::size_t> bytes_before(const PlyElement& element, std::size_t count, const PlyMeshParts& parts) {
    std::size_t bytes = 0;
    for (std::size_t p = 0; p < count; ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list && !parts.is_corners(element, p)) return std::nullopt;
        bytes += property.is_list ? size_of(property.count_type) + 3 * size_of(property.type) : size_of(property.type);
    }
    return bytes;
}

std::optional<std::size_t> row_length(const PlyElement& element, const PlyMeshParts& parts) {
    return bytes_before(element, element.properties.size(), parts);
}

/// Three coordinates of one type side by side are copied at once.
template <class Coordinate>
bool copy_points(const Rows& rows, std::size_t offset, Positions& X) {
    return all_of_range(static_cast<int>(X.rows()), [&](int v) {
        const auto point = value_at<std::array<Coordinate, 3>>(rows.row(v) + offset);
        bool good = true;
        for (int axis = 0; axis < 3; ++axis) {
            const auto x = static_cast<double>(point[static_cast<std::size_t>(axis)]);
            X(v, axis) = x;
            good &= std::abs(x) <= largest_coordinate;
        }
        return good;
    });
}

bool read_points(const Rows& rows, const PlyMeshParts& parts, Positions& X) {
    const PlyElement& element = *parts.vertices;
    const PlyType type = element.properties[parts.axis[0]].type;
    const bool side_by_side = parts.axis[1] == parts.axis[0] + 1 && parts.axis[2] == parts.axis[0] + 2;
    const auto is_of_type = [&](std::size_t p) { return element.properties[p].type == type; };
    if (!side_by_side || !std::all_of(parts.axis.begin(), parts.axis.end(), is_of_type)) return false;
    const std::size_t offset = *bytes_before(element, parts.axis[0], parts);
    if (type == PlyType::float32) return copy_points<float>(rows, offset, X);
    return type == PlyType::float64 && copy_points<double>(rows, offset, X);
}

/// Faces of three corners, each a vertex that exists.
bool read_corners(const Rows& rows, const PlyMeshParts& parts, Faces& F) {
    const PlyElement& element = *parts.faces;
    const PlyProperty& list = element.properties[parts.corners];
    const bool common = size_of(list.count_type) == 1 && (list.type == PlyType::int32 || list.type == PlyType::uint32);
    if (!common) return false;
    const std::size_t offset = *bytes_before(element, parts.corners, parts);
    const auto vertices = static_cast<std::uint32_t>(parts.vertices->count);
    return all_of_range(static_cast<int>(F.rows()), [&](int t) {
        const char* const count = rows.row(t) + offset;
        const auto corner = value_at<std::array<std::uint32_t, 3>>(count + 1);   // what is negative is too large
        bool good = *count == 3;
        for (int k = 0; k < 3; ++k) {
            F(t, k) = static_cast<int>(corner[static_cast<std::size_t>(k)]);
            good &= corner[static_cast<std::size_t>(k)] < vertices;
        }
        return good;
    });
}

}   // namespace

PlyMeshParts mesh_parts(const PlyHeader& header, const std::string& file) {
    PlyMeshParts parts{};
    parts.vertices = element_named(header, "vertex");
    if (parts.vertices == nullptr) fail(file, 0, "no vertex element", "export the mesh with its vertices");
    for (const char* name : {"x", "y", "z"}) {
        const auto p = property_named(*parts.vertices, name);
        if (!p) fail(file, 0, std::string("element vertex has no property '") + name + "'", "a mesh needs x, y and z");
        const PlyProperty& property = parts.vertices->properties[*p];
        if (property.is_list) fail(file, property.line, std::string("property '") + name + "' is a list", "it must be one number");
        parts.axis[static_cast<std::size_t>(*name - 'x')] = *p;
    }
    const PlyElement* const faces = element_named(header, "face");
    const PlyElement* const strips = element_named(header, "tristrips");
    parts.are_strips = strips != nullptr && (faces == nullptr || faces->count == 0);
    parts.faces = parts.are_strips ? strips : faces;
    parts.ignored = parts.are_strips ? nullptr : strips;
    if (parts.faces == nullptr) fail(file, 0, "no face element", "export the mesh as polygons");
    const auto indices = property_named(*parts.faces, "vertex_indices"), index = property_named(*parts.faces, "vertex_index");
    if (!indices && !index) {
        fail(file, parts.faces->line, "element " + parts.faces->name + " has no property 'vertex_indices'", "export the mesh as polygons");
    }
    parts.corners = std::max(indices.value_or(0), index.value_or(0));
    const PlyProperty& corners = parts.faces->properties[parts.corners];
    if (!corners.is_list || !is_integer(corners.type))
        fail(file, corners.line, "vertex index type must be a list of an integer type", "such as int");
    return parts;
}

std::optional<PlyTriangles> read_triangle_rows(std::string_view bytes, const PlyHeader& header, const PlyMeshParts& parts) {
    constexpr auto ours = std::endian::native == std::endian::big ? PlyHeader::Format::big_endian : PlyHeader::Format::little_endian;
    if (header.format != ours || parts.are_strips || parts.faces->count == 0 || parts.faces->count > most_triangles) return std::nullopt;
    Rows points{}, triangles{};
    std::size_t at = header.size;
    for (const PlyElement& element : header.elements) {
        const auto length = row_length(element, parts);
        const auto count = static_cast<std::size_t>(element.count);
        if (!length || (count > 0 && *length > (bytes.size() - at) / count)) return std::nullopt;
        if (&element == parts.vertices) points = {bytes.data() + at, *length};
        if (&element == parts.faces) triangles = {bytes.data() + at, *length};
        at += *length * count;
    }
    PlyTriangles found{{}, at};
    found.mesh.X.resize(parts.vertices->count, 3);
    found.mesh.F.resize(parts.faces->count, 3);
    prefer_large_pages(found.mesh.X.data(), static_cast<std::size_t>(found.mesh.X.size()) * sizeof(double));
    prefer_large_pages(found.mesh.F.data(), static_cast<std::size_t>(found.mesh.F.size()) * sizeof(int));
    if (!read_points(points, parts, found.mesh.X) || !read_corners(triangles, parts, found.mesh.F)) return std::nullopt;
    return found;
}

}   // namespace meshfolio
