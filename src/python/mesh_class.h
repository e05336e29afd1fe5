/// @file
/// The class Mesh of the Python module, with names known from trimesh and PyVista.
#pragma once

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesh/orientation.h"
#include "mesh/triangle_measures.h"
#include "python/mesh_arrays.h"

namespace meshfolio::python {

/// Returns the mesh of arrays, with its polygons as triangles. @throws MeshError
inline LoadedMesh loaded_from(const py::object& vertices, const py::object& faces, const std::string& name) {
    Positions X = positions_of(vertices, name);
    const PolygonList polygons = polygons_of(faces, X.rows(), name);
    return triangulated(polygons, std::move(X), name, {});
}

inline Mesh new_mesh(const py::object& vertices, const py::object& faces, const std::string& name, const py::object& attributes) {
    LoadedMesh loaded = loaded_from(vertices, faces, name);
    py::dict own = checked(copy_of(attributes), loaded.mesh.X.rows());
    Mesh mesh = mesh_of(interruptible([&loaded](const Stop&) { return prepare_mesh(std::move(loaded)); }));
    mesh.attributes = std::move(own);
    return mesh;
}

/// Moves the vertices. Arrays that show the old ones keep them. @throws MeshError
inline void set_vertices(Mesh& mesh, const py::object& vertices) {
    Positions X = positions_of(vertices, mesh.prepared->file);
    if (X.rows() != mesh.triangles().X.rows())
        throw MeshError("vertices have " + std::to_string(X.rows()) + " rows, the mesh has " + std::to_string(mesh.triangles().X.rows()),
                        "for another number make a new Mesh(vertices, faces)");
    auto moved = moved_to(*mesh.prepared, std::move(X));
    if (moved->preflight.box_low == moved->preflight.box_high) throw MeshError("all vertices coincide", "a mesh needs an extent");
    mesh.prepared = std::move(moved);
    mesh.moved = true;
}

inline void set_name(Mesh& mesh, const py::object& name) {
    PreparedMesh named = *mesh.prepared;
    named.file = py::module_::import("meshfolio._arguments").attr("checked")("name", name, "str").cast<std::string>();
    mesh.prepared = std::make_shared<const PreparedMesh>(std::move(named));
}

/// True if every edge lies between two triangles.
inline bool is_watertight(const Mesh& mesh) {
    const std::vector<Edge>& edges = mesh.prepared->topology.edges;
    return std::ranges::all_of(edges, [](const Edge& edge) { return edge.faces == 2; });
}

/// Returns vertices in use − edges + triangles.
inline int euler_number(const Mesh& mesh) {
    const Preflight& counts = mesh.prepared->preflight;
    return counts.vertices_in_use - static_cast<int>(mesh.prepared->topology.edges.size()) + counts.triangles;
}

inline Eigen::Matrix<double, 2, 3, Eigen::RowMajor> bounds_of(const Mesh& mesh) {
    const Box box = bounding_box(mesh.triangles());
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> bounds;
    bounds << box.low.transpose(), box.high.transpose();
    return bounds;
}

inline py::list warnings_of(const Mesh& mesh) {
    py::list lines;
    for (const MeshWarning& warning : mesh.prepared->warnings) lines.append(printable(warning.message));
    return lines;
}

/// Returns the name of the mesh, with U+FFFD for bytes of a file name that are not UTF-8.
inline py::str name_of(const Mesh& mesh) {
    const std::string& name = mesh.prepared->file;
    return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(name.data(), static_cast<py::ssize_t>(name.size()), "replace"));
}

inline Mesh copy_of(const Mesh& mesh) { return {mesh.prepared, copy_of(mesh.attributes), mesh.moved}; }

/// Returns the complete state for pickling, which mesh_of_state() reads; the mesh then counts as moved, so that it is not oriented again.
inline py::tuple state_of(const Mesh& mesh) {
    const Attributes& kept = mesh.prepared->attributes;
    return py::make_tuple(mesh.triangles().X, mesh.triangles().F, name_of(mesh), warnings_of(mesh), mesh.attributes, py::bytes(kept.obj),
                          kept.face_lines, !kept.columns.empty());
}

inline Mesh mesh_of_state(const py::tuple& state) {
    PreparedMesh mesh;
    mesh.file = state[2].cast<std::string>();
    mesh.mesh = loaded_from(state[0], state[1], mesh.file).mesh;
    mesh.topology = topology_of(mesh.mesh);
    for (const auto& message : state[3]) mesh.warnings.push_back({message.cast<std::string>()});
    mesh.attributes = {{}, state[5].cast<std::string>(), state[6].cast<std::vector<long>>()};
    if (state[7].cast<bool>()) {   // computed when they are written
        for (const char* name : {"nx", "ny", "nz"}) mesh.attributes.columns.push_back({name, Vector::Zero(mesh.mesh.X.rows())});
    }
    const py::dict attributes = checked(state[4], mesh.mesh.X.rows());
    return {measured(std::move(mesh)), attributes, true};
}

inline void add_mesh(py::module_& m) {
    const auto vertices = [](const Mesh& mesh) { return rows_of(mesh.triangles().X, mesh); };
    const auto attributes = [](const Mesh& mesh) { return mesh.attributes; };
    const auto set_attributes = [](Mesh& mesh, const py::object& arrays) { mesh.attributes = checked(arrays, mesh.triangles().X.rows()); };
    const auto copied = [](const Mesh& mesh) { return copy_of(mesh); };
    py::class_<Mesh> mesh_class(
        m, "Mesh",
        "A triangle mesh.\n\n"
        "Faces that name a vertex twice, and repeated ones, are dropped, and the rest is turned consistently, outwards where\n"
        "closed; `warnings` says what was done. Vertices keep their rows. `vertices`, `attributes` and `name` can be set.");
    mesh_class.def(py::init(&new_mesh))
        .def_property("vertices", vertices, &set_vertices,
                      "n x 3 float64 [length], read-only, no copy. Set n x 3 coordinates to move the vertices, such as\n"
                      "`mesh.vertices = 2 * mesh.vertices`; arrays taken before keep the old ones")
        .def_property("points", vertices, &set_vertices, "vertices, under PyVista's name for them")
        .def_property(
            "faces", [](const Mesh& mesh) { return rows_of(mesh.triangles().F, mesh); },
            [](const Mesh&, const py::object&) {
                throw py::attribute_error("the faces of a Mesh cannot be set; make a new one: Mesh(vertices, faces)");
            },
            "m x 3 int32, read-only, no copy")
        .def_property("attributes", attributes, set_attributes,
                      "a dict, name -> n numbers (or n x k), read and written: colours, quality, … of the file; save() writes them,\n"
                      "smooth() and noise() keep them. Normals are computed anew when they are written")
        .def_property("vertex_attributes", attributes, set_attributes, "attributes, under trimesh's name for them")
        .def_property("point_data", attributes, set_attributes, "attributes, under PyVista's name for them")
        .def_property("name", &name_of, &set_name, "file it was read from, or what it was called")
        .def_property_readonly("warnings", &warnings_of, "a list of sentences: oddities found when it was read, and repairs");
    mesh_class
        .def_property_readonly(
            "n_points", [](const Mesh& mesh) { return mesh.triangles().vertex_count(); }, "vertices")
        .def_property_readonly(
            "n_cells", [](const Mesh& mesh) { return mesh.triangles().face_count(); }, "faces")
        .def_property_readonly(
            "area", [](const Mesh& mesh) { return surface_area(mesh.triangles()); }, "of all faces [length^2]")
        .def_property_readonly(
            "volume", [](const Mesh& mesh) { return enclosed_volume(mesh.triangles(), mesh.prepared->topology); },
            "enclosed [length^3], of cavities negative; NaN where triangles do not run through each edge as often one way as the\n"
            "other (open, not orientable, with a wall inside): such a mesh encloses no volume")
        .def_property_readonly(
            "why_no_volume", [](const Mesh& mesh) { return why_no_volume(mesh.triangles(), mesh.prepared->topology); },
            "in words, why the volume is NaN; empty where it is not")
        .def_property_readonly("bounds", &bounds_of, "2 x 3: least and greatest coordinates of what faces use [length]")
        .def_property_readonly("is_watertight", &is_watertight, "every edge lies between two faces")
        .def_property_readonly("euler_number", &euler_number, "vertices that faces use - edges + faces")
        .def_property_readonly(
            "face_normals", [](const Mesh& mesh) { return face_normals(mesh.triangles()); }, "m x 3 of length 1; 0 without area")
        .def_property_readonly(
            "vertex_normals", [](const Mesh& mesh) { return vertex_normals(mesh.triangles()); },
            "n x 3 of length 1, the area-weighted mean of the faces around; 0 without area");
    m.def("_attribute", &attribute_of);
    refuse_empty<Mesh>("make it by Mesh(vertices, faces)");
    mesh_class.def("__copy__", copied)
        .def("__deepcopy__", [](const Mesh& mesh, const py::dict& /*seen*/) { return copy_of(mesh); })
        .def(py::pickle(&state_of, &mesh_of_state))
        .def("__repr__", [](const Mesh& mesh) {
            return "<meshfolio.Mesh " + printable(mesh.prepared->file) + ": " + std::to_string(mesh.triangles().vertex_count()) +
                   " vertices, " + std::to_string(mesh.triangles().face_count()) + " faces>";
        });
}

}   // namespace meshfolio::python
