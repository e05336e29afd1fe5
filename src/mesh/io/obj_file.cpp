#include <tiny_obj_loader.h>

#include <sstream>
#include <utility>

#include "base/errors.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/obj_gate.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

/// The faces that tinyobjloader finds and passes on one by one: so it stores nothing, and polygons may have any size. It does not read the
/// coordinates, because it rounds about half of all decimal numbers wrongly in the last digits.
struct FoundFaces {
    const std::vector<long>& lines;
    PolygonList polygons;
};

void add_face(void* user, tinyobj::index_t* corners, int count) {
    FoundFaces& found = *static_cast<FoundFaces*>(user);
    for (int k = 0; k < count; ++k) found.polygons.add_corner(corners[k].vertex_index - 1);
    const std::size_t number = found.polygons.size();
    found.polygons.end_polygon(number < found.lines.size() ? found.lines[number] : 0);
}

/// Checks that the file has vertices and faces. @throws InputError if it has none, or an index is too large
void check_content(const CheckedObj& checked, const PolygonList& polygons, const std::string& file) {
    const std::string hint = checked.unknown.empty() ? "" : "the first unknown statement is " + checked.unknown;
    const int vertices = static_cast<int>(checked.coordinates.size() / 3);
    for (std::size_t i = 0; i < polygons.size(); ++i)
        for (const int v : polygons.polygon(i))
            if (v >= vertices)
                throw InputError(
                    {file, polygons.line(i)},
                    "vertex index " + std::to_string(v + 1) + " is not a valid index (file has " + vertex_count(vertices) + ")",
                    hint.empty() ? "the file may be cut off" : hint);
    if (vertices == 0) throw InputError({file, 0}, "no vertices", hint.empty() ? "is this a mesh in OBJ format?" : hint);
    if (polygons.size() == 0)
        throw InputError({file, 0}, checked.free_form ? "no polygon faces (free-form surfaces are not supported)" : "no polygon faces",
                         hint.empty() ? "export the mesh as polygons" : hint);
}

/// Returns the colours as columns of bytes. Colours go up to 255 if one is above 1, else up to 1; vertices without a colour are white.
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
    FoundFaces found{checked.face_lines, {}};
    found.polygons.reserve(checked.face_lines.size());
    tinyobj::callback_t callback;
    callback.index_cb = add_face;
    std::istringstream stream(std::move(checked.text));
    std::string warnings, errors;
    // No material reader: no other file is ever opened.
    const bool parsed = tinyobj::LoadObjWithCallback(stream, callback, &found, nullptr, &warnings, &errors);
    if (!parsed || found.polygons.size() != checked.face_lines.size())
        throw MeshError("tinyobjloader found " + std::to_string(found.polygons.size()) + " faces where the check of the file found " +
                            std::to_string(checked.face_lines.size()) + ": " + errors + warnings,
                        "export the mesh again", {file, 0});
    check_content(checked, found.polygons, file);
    std::vector<VertexColumn> colors = keep == Keep::attributes ? colors_of(checked) : std::vector<VertexColumn>();
    Positions X = Eigen::Map<const Positions>(checked.coordinates.data(), static_cast<Eigen::Index>(checked.coordinates.size() / 3), 3);
    LoadedMesh loaded = triangulated(found.polygons, std::move(X), file, std::move(checked.warnings));
    if (keep == Keep::attributes) {
        loaded.attributes.obj = without_bom(text);
        loaded.attributes.face_lines = loaded.face_lines;
        loaded.attributes.columns = std::move(colors);
    }
    return loaded;
}

}   // namespace meshfolio
