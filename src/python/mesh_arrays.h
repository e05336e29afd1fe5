/// @file
/// Meshes, attributes and pictures as NumPy arrays. Results are handed over without a copy, and a mesh shows its own memory, read-only;
/// input is copied once, into the mesh.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/mesh_checks.h"
#include "png/png.h"
#include "python/interruptible.h"
#include "run/one_mesh/mesh_pictures.h"

namespace meshfolio::python {

namespace py = pybind11;
using namespace py::literals;

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

/// Converts arrays to columns; an n × k array becomes the columns NAME_0, NAME_1, …
/// @throws MeshError for an array that is not of numbers or has not n rows
inline std::vector<VertexColumn> columns_of(const py::dict& arrays, Eigen::Index n) {
    std::vector<VertexColumn> columns;
    for (const auto& [key, value] : arrays) {
        const std::string name = py::str(key), about = "attribute '" + printable(name) + "'";
        const py::array array = py::array::ensure(value);
        if (!array || std::string("biuf").find(array.dtype().kind()) == std::string::npos)
            throw MeshError(about + " holds no numbers", "give an array of booleans, integers or floats");
        if (array.ndim() < 1 || array.ndim() > 2) throw MeshError(about + " has neither one axis nor two", "give n numbers or n x k");
        if (array.shape(0) != n)
            throw MeshError(about + " has " + std::to_string(array.shape(0)) + " values, the mesh has " + std::to_string(n) + " vertices",
                            "give one row a vertex");
        const auto values = array.cast<DenseMatrix>();
        const ScalarType type = type_in_files(array.dtype(), values);
        for (Eigen::Index k = 0; k < values.cols(); ++k)
            columns.push_back({array.ndim() == 1 ? name : name + '_' + std::to_string(k), values.col(k), type});
    }
    return columns;
}

// ---- meshes ----------------------------------------------------------------------------------------------------------------

/// A mesh of Python. Its surface never changes: functions return new meshes.
struct Mesh {
    std::shared_ptr<const PreparedMesh> prepared;   // its only columns are the normals of the file
    py::dict attributes;                            // may be changed by the user
    bool moved = false;                             // its positions are not those of the preflight

    const TriangleMesh& triangles() const { return prepared->mesh; }
};

/// Returns a dict of these arrays (meshfolio._Attributes) that refuses arrays without n rows. @throws MeshError if one of them has not n
/// rows
inline py::dict checked(const py::dict& arrays, Eigen::Index n) { return py::module_::import("meshfolio").attr("_Attributes")(n, arrays); }

inline Mesh mesh_of(PreparedMesh prepared) {
    py::dict attributes = checked(dict_of(prepared.attributes.columns), prepared.mesh.X.rows());
    std::erase_if(prepared.attributes.columns, [](const VertexColumn& column) { return !is_normal(column); });
    return {std::make_shared<const PreparedMesh>(std::move(prepared)), std::move(attributes)};
}

/// Returns a deep copy of a dict with its arrays.
inline py::dict copy_of(const py::dict& arrays) { return py::module_::import("copy").attr("deepcopy")(arrays); }

/// Returns the mesh at positions X, with a copy of its attributes and the orientation of its triangles.
inline Mesh moved_to(const Mesh& mesh, Positions X) {
    PreparedMesh moved = *mesh.prepared;
    moved.mesh.X = std::move(X);
    return {std::make_shared<const PreparedMesh>(std::move(moved)), copy_of(mesh.attributes), true};
}

/// Returns all that a file stores besides the triangles: normals and text of the file that was read, and the attributes as columns.
inline Attributes attributes_of(const Mesh& mesh) {
    Attributes all = mesh.prepared->attributes;
    for (VertexColumn& column : columns_of(mesh.attributes, mesh.triangles().X.rows())) all.columns.push_back(std::move(column));
    return all;
}

// ---- arrays in -------------------------------------------------------------------------------------------------------------

/// Returns the object as an n × 3 array. @param kinds  allowed for its numbers: i, u, f @throws MeshError for another shape or kind
inline py::array rows_of_three(const py::object& rows, const std::string& name, const std::string& kinds) {
    const py::array array = py::array::ensure(rows);
    if (!array || kinds.find(array.dtype().kind()) == std::string::npos)
        throw MeshError(name + (kinds == "iu" ? " are no integers" : " are no numbers"));
    if (array.ndim() == 2 && array.shape(1) == 3) return array;
    std::string shape;
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) shape += (axis > 0 ? " x " : "") + std::to_string(array.shape(axis));
    throw MeshError(name + " have the shape " + shape + ", not n x 3",
                    kinds == "iu" ? "of PyVista's take faces.reshape(-1, 4)[:, 1:]" : "");
}

inline TriangleMesh triangles_of(const py::object& vertices, const py::object& faces, const std::string& name) {
    using Indices = Eigen::Matrix<long long, Eigen::Dynamic, 3, Eigen::RowMajor>;
    TriangleMesh mesh;
    mesh.X = rows_of_three(vertices, "vertices", "iuf").cast<Positions>();
    const Indices indices = rows_of_three(faces, "faces", "iu").cast<Indices>();
    for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) {
        if (!mesh.X.row(v).allFinite())
            throw MeshError("vertex " + std::to_string(v) + " is not finite", "every coordinate must be a number", {name});
    }
    for (Eigen::Index t = 0; t < indices.rows(); ++t) {
        if (indices.row(t).minCoeff() < 0 || indices.row(t).maxCoeff() >= mesh.X.rows())
            throw MeshError("face " + std::to_string(t) + " names a vertex that is not there",
                            "indices lie from 0 to " + std::to_string(mesh.X.rows() - 1), {name});
    }
    mesh.F = indices.cast<int>();
    return mesh;
}

/// Returns (N, N) for N, or (width, height). @throws UsageError unless both are whole numbers from 1 to run::largest_side
inline std::pair<int, int> picture_size(const py::object& size) {
    std::pair<int, int> sides;
    try {
        sides = PyIndex_Check(size.ptr()) != 0 ? std::pair{size.cast<int>(), size.cast<int>()} : size.cast<std::pair<int, int>>();
    } catch (const py::cast_error&) {   // not numbers: refused below
    }
    const auto [width, height] = sides;
    if (std::min(width, height) < 1 || std::max(width, height) > run::largest_side)
        throw UsageError("size is not N or (width, height)", "both between 1 and " + std::to_string(run::largest_side));
    return sides;
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

inline py::array array_of(render::Image picture) {
    const auto kept = std::make_shared<const render::Image>(std::move(picture));
    static_assert(sizeof(render::Rgba) == 4);
    return array_over(reinterpret_cast<const std::uint8_t*>(kept->pixels.data()), {kept->height, kept->width, 4}, kept);
}

inline py::bytes png_of(const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>& array) {
    if (array.ndim() != 3 || array.shape(2) != 4) throw UsageError("a picture is height x width x 4", "RGBA, 8 bits each");
    render::Image picture(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
    std::copy_n(array.data(), array.size(), reinterpret_cast<std::uint8_t*>(picture.pixels.data()));
    return render::encode_png(picture);
}

}   // namespace meshfolio::python
