#include <tiny_obj_loader.h>

#include <istream>
#include <streambuf>
#include <utility>

#include "base/errors.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/obj_gate.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

/// Lets a stream read from memory without a copy.
class MemoryBuffer : public std::streambuf {
public:
    explicit MemoryBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

/// The faces that tinyobjloader finds, handed to us one by one: it then stores nothing, and polygons may have any size. The
/// coordinates do not go through it, because it rounds about half of all decimal numbers wrongly in the last digits.
struct Found {
    const CheckedObj& checked;
    std::size_t vertices;
    PolygonList polygons;
    int too_large = 0;   // the first index beyond the vertices, from 1; 0: none
    long too_large_line = 0;
};

void add_face(void* user, tinyobj::index_t* corners, int count) {
    Found& found = *static_cast<Found*>(user);
    const std::size_t number = found.polygons.size();
    const long line = number < found.checked.face_lines.size() ? found.checked.face_lines[number] : 0;
    for (int k = 0; k < count; ++k) {
        const int index = corners[k].vertex_index;
        if (found.too_large == 0 && static_cast<std::size_t>(index) > found.vertices) {
            found.too_large = index;
            found.too_large_line = line;
        }
        found.polygons.add_corner(index - 1);
    }
    found.polygons.end_polygon(line);
}

void parse_checked(CheckedObj& checked, Found& found) {
    tinyobj::callback_t callback;
    callback.index_cb = add_face;
    MemoryBuffer buffer(checked.text);
    std::istream stream(&buffer);
    std::string warnings, errors;
    // No material reader: no other file is ever opened.
    const bool parsed = tinyobj::LoadObjWithCallback(stream, callback, &found, nullptr, &warnings, &errors);
    if (!parsed || found.polygons.size() != checked.face_lines.size())
        throw MeshError("tinyobjloader disagrees with the check of the file: " + errors + warnings);
}

std::string vertex_count(std::size_t n) { return std::to_string(n) + (n == 1 ? " vertex" : " vertices"); }

void check_content(const Found& found, const std::string& file) {
    const CheckedObj& checked = found.checked;
    const std::string hint = checked.unknown.empty() ? "" : "the first unknown statement is " + checked.unknown;
    if (found.too_large > 0) {
        throw InputError(
            {file, found.too_large_line},
            "vertex index " + std::to_string(found.too_large) + " is not a valid index (file has " + vertex_count(found.vertices) + ")",
            hint.empty() ? "the file may be cut off" : hint);
    }
    if (found.vertices == 0) throw InputError({file, 0}, "no vertices", hint.empty() ? "is this a mesh in OBJ format?" : hint);
    if (found.polygons.size() == 0) {
        throw InputError({file, 0}, checked.free_form ? "no polygon faces (free-form surfaces are not supported)" : "no polygon faces",
                         hint.empty() ? "export the mesh as polygons" : hint);
    }
}

/// As bytes, which other formats take for colours; none where some vertex has none, or another range.
std::vector<VertexColumn> colors_of(const CheckedObj& checked) {
    const Eigen::Map<const Vector> colors(checked.colors.data(), static_cast<Eigen::Index>(checked.colors.size()));
    if (checked.colors.size() != checked.coordinates.size() || colors.minCoeff() < 0 || colors.maxCoeff() > 1) return {};
    const Vector bytes = (255 * colors).array().round();
    std::vector<VertexColumn> columns;
    for (const char* channel : {"red", "green", "blue"}) {
        const auto first = static_cast<Eigen::Index>(columns.size());
        columns.push_back({channel, bytes(Eigen::seq(first, Eigen::last, Eigen::fix<3>)), ScalarType::uint8});
    }
    return columns;
}

}   // namespace

LoadedMesh parse_obj(std::string_view text, const std::string& file, Keep keep) {
    CheckedObj checked = check_obj(text, file);
    Found found{checked, checked.coordinates.size() / 3, {}};
    found.polygons.reserve(checked.face_lines.size());
    parse_checked(checked, found);
    check_content(found, file);
    Positions X = Eigen::Map<const Positions>(checked.coordinates.data(), static_cast<Eigen::Index>(found.vertices), 3);
    LoadedMesh loaded = triangulated(found.polygons, std::move(X), file, std::move(checked.warnings));
    if (keep == Keep::attributes) {
        loaded.attributes.obj = without_bom(text);
        loaded.attributes.face_lines = loaded.face_lines;
        loaded.attributes.columns = colors_of(checked);
    }
    return loaded;
}

}   // namespace meshfolio
