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

inline Mesh new_mesh(const py::object& vertices, const py::object& faces, const std::string& name, const py::dict& attributes) {
    LoadedMesh loaded{triangles_of(vertices, faces, name), name, {}, {}};
    const py::dict own = checked(copy_of(attributes), loaded.mesh.X.rows());
    Mesh mesh = mesh_of(interruptible([loaded](const Stop&) { return prepare_mesh(loaded); }));
    mesh.attributes = own;
    return mesh;
}

/// True if every edge lies between two triangles.
inline bool is_watertight(const Mesh& mesh) {
    const std::vector<Edge>& edges = mesh.prepared->topology.edges;
    return std::ranges::all_of(edges, [](const Edge& edge) { return edge.faces == 2; });
}

/// Returns vertices in use − edges + triangles.
inline int euler_number(const Mesh& mesh) {
    const MeshTopology& topology = mesh.prepared->topology;
    int count = mesh.triangles().face_count() - static_cast<int>(topology.edges.size());
    for (int v = 0; v < mesh.triangles().vertex_count(); ++v) count += topology.vertex_faces.size(v) > 0 ? 1 : 0;
    return count;
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

inline Mesh copy_of(const Mesh& mesh) { return {mesh.prepared, copy_of(mesh.attributes), mesh.moved}; }

/// Returns the complete state for pickling, which mesh_of_state() reads; the mesh then counts as moved, so that it is not oriented again.
inline py::tuple state_of(const Mesh& mesh) {
    const Attributes& kept = mesh.prepared->attributes;
    return py::make_tuple(mesh.triangles().X, mesh.triangles().F, mesh.prepared->file, warnings_of(mesh), mesh.attributes,
                          py::bytes(kept.obj), kept.face_lines, !kept.columns.empty());
}

inline Mesh mesh_of_state(const py::tuple& state) {
    PreparedMesh mesh;
    mesh.file = state[2].cast<std::string>();
    mesh.mesh = triangles_of(state[0], state[1], mesh.file);
    mesh.topology = topology_of(mesh.mesh);
    for (const auto& message : state[3]) mesh.warnings.push_back({message.cast<std::string>()});
    mesh.attributes = {{}, state[5].cast<std::string>(), state[6].cast<std::vector<long>>()};
    if (state[7].cast<bool>()) {   // computed when they are written
        for (const char* name : {"nx", "ny", "nz"}) mesh.attributes.columns.push_back({name, Vector::Zero(mesh.mesh.X.rows())});
    }
    const py::dict attributes = checked(state[4].cast<py::dict>(), mesh.mesh.X.rows());
    return {std::make_shared<const PreparedMesh>(std::move(mesh)), attributes, true};
}

inline void add_mesh(py::module_& m) {
    const auto vertices = [](const Mesh& mesh) { return rows_of(mesh.triangles().X, mesh); };
    const auto attributes = [](const Mesh& mesh) { return mesh.attributes; };
    const auto copied = [](const Mesh& mesh) { return copy_of(mesh); };
    py::class_<Mesh> mesh_class(
        m, "Mesh",
        "A triangle mesh. Its surface is never changed: smooth() and noise() give new ones. `attributes` are yours to change.\n\n"
        "Faces that name a vertex twice, and repeated ones, are dropped, and the rest is turned consistently, outwards where\n"
        "closed; `warnings` says what was done. Vertices keep their rows.");
    mesh_class
        .def(py::init(&new_mesh), "vertices"_a, "faces"_a, "name"_a = "mesh", "attributes"_a = py::dict(),
             "vertices: n x 3 coordinates in any unit of length; faces: m x 3 rows of vertices, counter-clockwise seen from outside;\n"
             "attributes: names with n numbers each, or n x k.")
        .def_property_readonly("vertices", vertices, "n x 3 float64 [length], read-only, no copy")
        .def_property_readonly("points", vertices, "vertices, under PyVista's name for them")
        .def_property_readonly(
            "faces", [](const Mesh& mesh) { return rows_of(mesh.triangles().F, mesh); }, "m x 3 int32, read-only, no copy")
        .def_property_readonly(
            "attributes", attributes,
            "a dict, name -> n numbers (or n x k), read and written: colours, quality, … of the file; save() writes them,\n"
            "smooth() and noise() keep them. Normals are computed anew when they are written")
        .def_property_readonly("vertex_attributes", attributes, "attributes, under trimesh's name for them")
        .def_property_readonly("point_data", attributes, "attributes, under PyVista's name for them")
        .def_property_readonly(
            "name", [](const Mesh& mesh) { return mesh.prepared->file; }, "file it was read from, or what it was called")
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
    m.def("_check_attribute", [](const py::str& name, const py::object& values, Eigen::Index n) {
        py::dict one;
        one[name] = values;
        columns_of(one, n);   // throws for an array that cannot be saved
    });
    mesh_class.def("copy", copied, "The same surface, with attributes of its own.")
        .def("__copy__", copied)
        .def("__deepcopy__", [](const Mesh& mesh, const py::dict& /*seen*/) { return copy_of(mesh); })
        .def(py::pickle(&state_of, &mesh_of_state))
        .def("__repr__", [](const Mesh& mesh) {
            return "<meshfolio.Mesh " + printable(mesh.prepared->file) + ": " + std::to_string(mesh.triangles().vertex_count()) +
                   " vertices, " + std::to_string(mesh.triangles().face_count()) + " faces>";
        });
}

}   // namespace meshfolio::python
