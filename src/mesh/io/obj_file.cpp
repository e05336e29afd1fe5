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

/// As bytes, which other formats take for colours. The largest value tells whether they go up to 1 or to 255; vertices without one are
/// white.
std::vector<VertexColumn> colors_of(CheckedObj& checked) {
    if (checked.colored.empty()) return {};
    const auto vertices = static_cast<Eigen::Index>(checked.coordinates.size() / 3);
    const auto count = static_cast<Eigen::Index>(checked.colored.size());
    const Eigen::Map<const Positions> colors(checked.colors.data(), count, 3);
    const double largest = colors.maxCoeff();
    const bool are_bytes = largest > 1;
    if (colors.minCoeff() < 0 || largest > 255 || (are_bytes && (colors.array() != colors.array().round()).any())) {
        checked.warnings.add(0, "colours are not kept: they are neither from 0 to 1 nor whole numbers up to 255", "colours not kept");
        return {};
    }
    if (are_bytes) checked.warnings.add(0, "colours above 1 are taken as from 0 to 255", "colours above 1");
    if (count < vertices)
        checked.warnings.add(0, "vertices without a colour, white in other formats than OBJ", "vertices without a colour",
                             std::to_string(vertices - count));
    Positions bytes = Positions::Constant(vertices, 3, 255);
    bytes(checked.colored, Eigen::all) = ((are_bytes ? 1 : 255) * colors).array().round().matrix();
    std::vector<VertexColumn> columns;
    for (const char* channel : {"red", "green", "blue"}) columns.push_back({channel, bytes.col(std::ssize(columns)), ScalarType::uint8});
    return columns;
}

}   // namespace

LoadedMesh parse_obj(std::string_view text, const std::string& file, Keep keep) {
    CheckedObj checked = check_obj(text, file);
    Found found{checked, checked.coordinates.size() / 3, {}};
    found.polygons.reserve(checked.face_lines.size());
    parse_checked(checked, found);
    check_content(found, file);
    std::vector<VertexColumn> colors = keep == Keep::attributes ? colors_of(checked) : std::vector<VertexColumn>();
    Positions X = Eigen::Map<const Positions>(checked.coordinates.data(), static_cast<Eigen::Index>(found.vertices), 3);
    LoadedMesh loaded = triangulated(found.polygons, std::move(X), file, std::move(checked.warnings));
    if (keep == Keep::attributes) {
        loaded.attributes.obj = without_bom(text);
        loaded.attributes.face_lines = loaded.face_lines;
        loaded.attributes.columns = std::move(colors);
    }
    return loaded;
}

}   // namespace meshfolio
