/// @file
/// A mesh of Python, and its arrays and pictures as NumPy knows them. Results are handed over without a copy, and a mesh shows its own
/// memory, read-only. What comes in is copied once, into the mesh.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "mesh/mesh_checks.h"
#include "png/png.h"
#include "python/interruptible.h"
#include "python/vertex_attributes.h"
#include "run/one_mesh/mesh_pictures.h"

namespace meshfolio::python {

using namespace py::literals;

/// Its surface is never changed: what is computed from it makes a new one.
struct Mesh {
    std::shared_ptr<const PreparedMesh> prepared;   // whose columns are the file's normals alone
    py::dict attributes;                            // the user's to change
    bool moved = false;                             // not what the preflight saw

    const TriangleMesh& triangles() const { return prepared->mesh; }
};

/// A dict that refuses arrays of other than n rows when they are set. @throws MeshError where one of these has another number
inline py::dict checked(const py::dict& arrays, Eigen::Index n) { return py::module_::import("meshfolio").attr("_Attributes")(n, arrays); }

inline Mesh mesh_of(PreparedMesh prepared) {
    py::dict attributes = checked(dict_of(prepared.attributes.columns), prepared.mesh.X.rows());
    std::erase_if(prepared.attributes.columns, [](const VertexColumn& column) { return !is_normal(column); });
    return {std::make_shared<const PreparedMesh>(std::move(prepared)), std::move(attributes)};
}

/// With arrays of its own.
inline py::dict copy_of(const py::dict& arrays) { return py::module_::import("copy").attr("deepcopy")(arrays); }

/// The same triangles, with their orientation, over other positions.
inline Mesh moved_to(const Mesh& mesh, Positions X) {
    PreparedMesh moved = *mesh.prepared;
    moved.mesh.X = std::move(X);
    return {std::make_shared<const PreparedMesh>(std::move(moved)), copy_of(mesh.attributes), true};
}

/// Everything a file stores besides the triangles.
inline Attributes attributes_of(const Mesh& mesh) {
    Attributes all = mesh.prepared->attributes;
    for (VertexColumn& column : columns_of(mesh.attributes, mesh.triangles().X.rows())) all.columns.push_back(std::move(column));
    return all;
}

// ---- arrays in -------------------------------------------------------------------------------------------------------------

/// Rows of three numbers, of what NumPy takes for an array. @param kinds  of its numbers: i, u, f
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
        if (!mesh.X.row(v).allFinite()) throw MeshError("vertex " + std::to_string(v) + " is not finite", "", {name});
    }
    for (Eigen::Index t = 0; t < indices.rows(); ++t) {
        if (indices.row(t).minCoeff() < 0 || indices.row(t).maxCoeff() >= mesh.X.rows())
            throw MeshError("face " + std::to_string(t) + " names a vertex that is not there", "", {name});
    }
    mesh.F = indices.cast<int>();
    return mesh;
}

/// N or (width, height).
inline std::pair<int, int> picture_size(const py::object& size) {
    std::pair<int, int> sides;
    try {
        sides = PyIndex_Check(size.ptr()) != 0 ? std::pair{size.cast<int>(), size.cast<int>()} : size.cast<std::pair<int, int>>();
    } catch (const py::cast_error&) {   // no numbers: refused below
    }
    const auto [width, height] = sides;
    if (std::min(width, height) < 1 || std::max(width, height) > run::largest_side)
        throw UsageError("size is not N or (width, height)", "both between 1 and " + std::to_string(run::largest_side));
    return sides;
}

// ---- arrays out ------------------------------------------------------------------------------------------------------------

/// Memory of `owner` as an array that keeps it.
template <class Number, class Owner>
py::array_t<Number> array_over(const Number* numbers, std::vector<py::ssize_t> shape, Owner owner) {
    const py::capsule base(new Owner(std::move(owner)), [](void* kept) { delete static_cast<Owner*>(kept); });
    return py::array_t<Number>(std::move(shape), numbers, base);
}

template <class Matrix>
py::array rows_of(const Matrix& matrix, const Mesh& mesh) {
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
