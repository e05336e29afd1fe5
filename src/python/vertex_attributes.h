/// @file
/// What files hold of every vertex, as a dict of NumPy arrays and back.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "base/errors.h"
#include "mesh/io/mesh_encoders.h"

namespace meshfolio::python {

namespace py = pybind11;

/// New arrays of the type in the file; float64 for integers with undefined values. Normals are no attributes.
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

/// The type of a column in a file. Files have no 8-byte integers: these become int32 if all fit, else float64.
inline ScalarType type_in_files(const py::dtype& type, const DenseMatrix& values) {
    if (type.kind() == 'b') return ScalarType::uint8;
    if (type.kind() == 'f') return type.itemsize() <= 4 ? ScalarType::float32 : ScalarType::float64;
    const bool is_signed = type.kind() == 'i';
    switch (type.itemsize()) {
        case 1:
            return is_signed ? ScalarType::int8 : ScalarType::uint8;
        case 2:
            return is_signed ? ScalarType::int16 : ScalarType::uint16;
        case 4:
            return is_signed ? ScalarType::int32 : ScalarType::uint32;
        default:
            return values.size() == 0 || values.cwiseAbs().maxCoeff() < 0x1p31 ? ScalarType::int32 : ScalarType::float64;
    }
}

/// Columns of n numbers, or of n × k as NAME_0, NAME_1, …
/// @throws MeshError for what is none, or of another mesh
inline std::vector<VertexColumn> columns_of(const py::dict& arrays, Eigen::Index n) {
    std::vector<VertexColumn> columns;
    for (const auto& [key, value] : arrays) {
        const std::string name = py::str(key), told = "attribute '" + printable(name) + "'";
        const py::array array = py::array::ensure(value);
        if (!array || std::string("biuf").find(array.dtype().kind()) == std::string::npos) throw MeshError(told + " holds no numbers");
        if (array.ndim() < 1 || array.ndim() > 2) throw MeshError(told + " has neither one axis nor two", "give n numbers or n x k");
        if (array.shape(0) != n)
            throw MeshError(told + " has " + std::to_string(array.shape(0)) + " values, the mesh has " + std::to_string(n) + " vertices");
        const auto values = array.cast<DenseMatrix>();
        const ScalarType type = type_in_files(array.dtype(), values);
        for (Eigen::Index k = 0; k < values.cols(); ++k)
            columns.push_back({array.ndim() == 1 ? name : name + '_' + std::to_string(k), values.col(k), type});
    }
    return columns;
}

}   // namespace meshfolio::python
