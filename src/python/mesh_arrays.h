/// @file
/// Meshes and attributes as NumPy arrays. Results are handed over without a copy, and a mesh shows its own memory, read-only;
/// input is copied once, into the mesh.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/io/polygon_list.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_measures.h"
#include "python/interruptible.h"

namespace meshfolio::python {

namespace py = pybind11;
using namespace py::literals;

/// Warns at the line that calls a function of the package.
inline void warn(const std::string& text) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 3) != 0) throw py::error_already_set();
}

// ---- numbers in ------------------------------------------------------------------------------------------------------------

/// Returns the object as an array, with NaN where a masked array has no value.
/// @param kinds  allowed for its numbers: b, i, u, f @throws MeshError with this problem and remedy for another kind
inline py::array numbers_of(const py::handle& object, const std::string& problem, std::string_view kinds, const std::string& remedy) {
    const bool masked = py::hasattr(object, "mask") && py::hasattr(object, "filled") && py::hasattr(object, "dtype");
    const py::array array = py::array::ensure(masked ? object.attr("astype")("float64").attr("filled")(std::nan(""))
                                                     : py::reinterpret_borrow<py::object>(object));
    if (!array || kinds.find(array.dtype().kind()) == std::string_view::npos) throw MeshError(problem, remedy);
    return array;
}

inline std::string shape_of(const py::array& array) {
    std::string shape = array.ndim() == 0 ? "()" : "";
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) shape += (axis > 0 ? " x " : "") + std::to_string(array.shape(axis));
    return shape;
}

/// @throws MeshError unless the array has n rows @param about  subject and verb of the message
inline void require_rows(const py::array& array, Eigen::Index n, const std::string& about) {
    if (array.shape(0) != n)
        throw MeshError(about + std::to_string(array.shape(0)) + (array.shape(0) == 1 ? " value" : " values") + ", the mesh has " +
                            std::to_string(n) + " vertices",
                        "give one row a vertex, NaN where undefined");
}

/// Returns n numbers. @throws MeshError for anything else
inline Vector values_of(const py::object& values, Eigen::Index n) {
    const py::array array = numbers_of(values, "values are no numbers", "biuf", "give one number a vertex, NaN where undefined");
    if (array.ndim() < 1 || array.size() != array.shape(0))
        throw MeshError("values have the shape " + shape_of(array) + ", not n",
                        "give one number a vertex, such as one column: values[:, 0]");
    require_rows(array, n, "");
    return array.attr("ravel")().cast<Vector>();
}

// ---- attributes ------------------------------------------------------------------------------------------------------------

/// Returns a dict of name and array for the columns except normals: arrays of the column's type in the file, or of float64 for integers
/// with undefined values.
inline py::dict dict_of(const std::vector<VertexColumn>& columns) {
    py::dict arrays;
    for (const VertexColumn& column : columns) {
        if (is_normal(column)) continue;
        const bool undefined = is_integer(column.type) && column.values.array().isNaN().any();
        arrays[column.name.c_str()] = with_zero_of(undefined ? ScalarType::float64 : column.type, [&](auto zero) -> py::object {
            using Number = decltype(zero);
            py::array_t<Number> array(column.values.size());
            for (Eigen::Index v = 0; v < column.values.size(); ++v) array.mutable_data()[v] = static_cast<Number>(column.values[v]);
            return array;
        });
    }
    return arrays;
}

/// Returns the type with which a column of this dtype is written. Files have no 8-byte integers: these become int32 if all fit, else
/// float64. Booleans become uint8.
inline ScalarType type_in_files(const py::dtype& type, const DenseMatrix& values) {
    if (type.kind() == 'b') return ScalarType::uint8;
    if (type.kind() == 'f') return type.itemsize() <= 4 ? ScalarType::float32 : ScalarType::float64;
    const bool is_signed = type.kind() == 'i';
    switch (type.itemsize()) {
        case 1: return is_signed ? ScalarType::int8 : ScalarType::uint8;
        case 2: return is_signed ? ScalarType::int16 : ScalarType::uint16;
        case 4: return is_signed ? ScalarType::int32 : ScalarType::uint32;
        default: return values.size() == 0 || values.cwiseAbs().maxCoeff() < 0x1p31 ? ScalarType::int32 : ScalarType::float64;
    }
}

/// Returns an attribute as an array. @throws MeshError if it is not of numbers, n or n × k
inline py::array attribute_of(const std::string& name, const py::object& values, Eigen::Index n) {
    const std::string about = "attribute '" + printable(name) + "'";
    py::array array = numbers_of(values, about + " holds no numbers", "biuf", "give an array of booleans, integers or floats");
    if (array.ndim() < 1 || array.ndim() > 2) throw MeshError(about + " has neither one axis nor two", "give n numbers or n x k");
    require_rows(array, n, about + " has ");
    return array;
}

/// Converts arrays to columns; an n × k array becomes the columns NAME_0, NAME_1, … @throws MeshError as attribute_of
inline std::vector<VertexColumn> columns_of(const py::dict& arrays, Eigen::Index n) {
    std::vector<VertexColumn> columns;
    for (const auto& [key, value] : arrays) {
        const std::string name = py::str(key);
        const py::array array = attribute_of(name, py::reinterpret_borrow<py::object>(value), n);
        const auto values = array.cast<DenseMatrix>();
        const ScalarType type = type_in_files(array.dtype(), values);
        for (Eigen::Index k = 0; k < values.cols(); ++k)
            columns.push_back({array.ndim() == 1 ? name : name + '_' + std::to_string(k), values.col(k), type});
    }
    return columns;
}

// ---- meshes ----------------------------------------------------------------------------------------------------------------

/// A mesh of Python. A prepared mesh never changes, so that arrays and running work can share it; setters replace it.
struct Mesh {
    std::shared_ptr<const PreparedMesh> prepared;   // its only columns are the normals of the file
    py::dict attributes;                            // may be changed by the user
    bool moved = false;                             // its positions are not those of the preflight

    const TriangleMesh& triangles() const { return prepared->mesh; }
};

/// Returns a dict of these arrays (meshfolio._Attributes) that refuses arrays without n rows. @throws MeshError if one of them has not n
/// rows
inline py::dict checked(const py::object& arrays, Eigen::Index n) {
    return py::module_::import("meshfolio").attr("_Attributes")(n, arrays);
}

inline Mesh mesh_of(PreparedMesh prepared) {
    py::dict attributes = checked(dict_of(prepared.attributes.columns), prepared.mesh.X.rows());
    std::erase_if(prepared.attributes.columns, [](const VertexColumn& column) { return !is_normal(column); });
    return {std::make_shared<const PreparedMesh>(std::move(prepared)), std::move(attributes)};
}

/// Returns a deep copy of a dict with its arrays.
inline py::object copy_of(const py::object& arrays) { return py::module_::import("copy").attr("deepcopy")(arrays); }

/// Returns the prepared mesh with the counts and the box that pictures need, all else as it is.
inline std::shared_ptr<const PreparedMesh> measured(PreparedMesh mesh) {
    const Box box = bounding_box(mesh.mesh);
    mesh.preflight.box_low = box.low, mesh.preflight.box_high = box.high;
    mesh.preflight.triangles = mesh.mesh.face_count();
    mesh.preflight.vertices_in_use = 0;
    for (int v = 0; v < mesh.mesh.vertex_count(); ++v) mesh.preflight.vertices_in_use += mesh.topology.vertex_faces.size(v) > 0 ? 1 : 0;
    return std::make_shared<const PreparedMesh>(std::move(mesh));
}

/// Returns the surface at positions X, with the orientation of its triangles.
inline std::shared_ptr<const PreparedMesh> moved_to(PreparedMesh mesh, Positions X) {
    mesh.mesh.X = std::move(X);
    return measured(std::move(mesh));
}

/// Returns the mesh at positions X, with a copy of its attributes.
inline Mesh moved_to(const Mesh& mesh, Positions X) { return {moved_to(*mesh.prepared, std::move(X)), copy_of(mesh.attributes), true}; }

/// Returns all that a file stores besides the triangles: normals and text of the file that was read, and the attributes as columns.
inline Attributes attributes_of(const Mesh& mesh) {
    Attributes all = mesh.prepared->attributes;
    for (VertexColumn& column : columns_of(mesh.attributes, mesh.triangles().X.rows())) all.columns.push_back(std::move(column));
    return all;
}

// ---- arrays in -------------------------------------------------------------------------------------------------------------

/// Returns the object as an n × 3 array. @param kinds  allowed for its numbers @throws MeshError for another shape or kind
inline py::array rows_of_three(const py::array& array, const std::string& name, const std::string& remedy) {
    if (array.ndim() != 2 || array.shape(1) != 3) throw MeshError(name + " have the shape " + shape_of(array) + ", not n x 3", remedy);
    return array;
}

inline Positions positions_of(const py::object& vertices, const std::string& name) {
    const py::array array = numbers_of(vertices, "vertices are no numbers", "iuf", "give n x 3 coordinates");
    Positions X = rows_of_three(array, "vertices", "").cast<Positions>();
    for (Eigen::Index v = 0; v < X.rows(); ++v) {
        if (!(X.row(v).array().abs() <= largest_coordinate).all())
            throw MeshError("vertex " + std::to_string(v) + " is not finite", "every coordinate must be a number within 1e100", {name});
    }
    return X;
}

/// Returns the polygons of rows of three vertices, or of one row of numbers as PyVista has it: k, then k vertices, and so on.
/// @param n  vertices @throws MeshError
inline PolygonList polygons_of(const py::object& faces, Eigen::Index n, const std::string& name) {
    const std::string forms = "give m x 3 vertices, polygons, or 3, a, b, c, 3, a, b, c, … as PyVista has it";
    const py::array array = numbers_of(faces, "faces are no integers", "iu", forms);
    const bool counted = array.ndim() == 1;   // each polygon begins with its number of corners
    const auto flat = (counted ? array : rows_of_three(array, "faces", forms)).attr("ravel")().cast<Eigen::VectorX<long long>>();
    PolygonList polygons;
    polygons.reserve(static_cast<std::size_t>(flat.size() / 3));
    for (Eigen::Index i = 0; i < flat.size(); polygons.end_polygon(0)) {
        const long long corners = counted ? flat[i++] : 3;
        if (corners < 1 || corners > flat.size() - i)
            throw MeshError(
                "faces[" + std::to_string(i - 1) + "] is " + std::to_string(corners) + ", not the number of corners that follow", forms);
        for (const Eigen::Index end = i + corners; i < end; ++i) {
            if (flat[i] < 0 || flat[i] >= n)
                throw MeshError(
                    "face " + std::to_string(polygons.size()) + " names vertex " + std::to_string(flat[i]) + ", which is not there",
                    "indices lie from 0 to " + std::to_string(n - 1), {name});
            polygons.add_corner(static_cast<int>(flat[i]));
        }
    }
    return polygons;
}

// ---- objects of the module ---------------------------------------------------------------------------------------------------

/// Makes uses of an object that was made by CLASS.__new__(CLASS), without its data, an error.
template <class Object> void refuse_empty(const char* remedy) {
    static const char* const kept = remedy;
    py::detail::get_type_info(typeid(Object))->operator_new = [](std::size_t) -> void* { throw UsageError("the object is empty", kept); };
}

// ---- arrays out ------------------------------------------------------------------------------------------------------------

/// Returns an array over `numbers`, memory of `owner`, without a copy; the array keeps the owner alive.
template <class Number, class Owner> py::array_t<Number> array_over(const Number* numbers, std::vector<py::ssize_t> shape, Owner owner) {
    const py::capsule base(new Owner(std::move(owner)), [](void* kept) { delete static_cast<Owner*>(kept); });
    return py::array_t<Number>(std::move(shape), numbers, base);
}

template <class Matrix> py::array rows_of(const Matrix& matrix, const Mesh& mesh) {
    py::array rows = array_over(matrix.data(), {matrix.rows(), matrix.cols()}, mesh.prepared);
    rows.attr("setflags")("write"_a = false);
    return rows;
}

}   // namespace meshfolio::python
