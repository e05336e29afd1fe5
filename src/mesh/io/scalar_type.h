/// @file
/// The types of numbers in binary files, and columns of such numbers: the values of vertices.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// The names of the types in VTK's XML files, in the order of ScalarType.
inline constexpr std::array<std::string_view, 10> vtk_type_names{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                                 "UInt32", "Int64", "UInt64", "Float32", "Float64"};

/// Returns use(zero), where zero has the C++ type for `type`.
template <class Use> auto with_zero_of(ScalarType type, const Use& use) {
    switch (type) {
        case ScalarType::int8: return use(std::int8_t{});
        case ScalarType::uint8: return use(std::uint8_t{});
        case ScalarType::int16: return use(std::int16_t{});
        case ScalarType::uint16: return use(std::uint16_t{});
        case ScalarType::int32: return use(std::int32_t{});
        case ScalarType::uint32: return use(std::uint32_t{});
        case ScalarType::int64: return use(std::int64_t{});
        case ScalarType::uint64: return use(std::uint64_t{});
        case ScalarType::float32: return use(float{});
        case ScalarType::float64: break;
    }
    return use(double{});
}

/// Returns the bytes that a number takes in a binary file.
inline std::size_t size_of(ScalarType type) {
    return with_zero_of(type, [](auto zero) { return sizeof(zero); });
}

inline bool is_integer(ScalarType type) {
    return with_zero_of(type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
}

/// Returns the number at `raw`. @param swapped  its bytes are in the opposite of the machine's order
template <class T> T value_at(const char* raw, bool swapped) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), raw, sizeof(T));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

/// Returns the little-endian number at `raw`.
template <class T> T little_endian(const char* raw) { return value_at<T>(raw, std::endian::native == std::endian::big); }

/// Appends the bytes of a number, little endian.
template <class T> void append_little_endian(std::string& bytes, T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

/// One number per vertex: a channel of its colour, a quality, a curvature.
struct VertexColumn {
    std::string name;
    Vector values;                           // n, each within the range of the type; NaN: not defined
    ScalarType type = ScalarType::float64;   // in files
    std::string array = {};                  // name of the array of several numbers per vertex that it is part of; empty: none
};

/// Returns the name of the column for component `part`, from 0, of an array: "velocity_x" for part 0 of 3, "stress_4" for part 4 of 6.
inline std::string component_name(const std::string& array, std::size_t part, std::size_t parts) {
    return array + "_" + (parts == 3 ? std::string(1, "xyz"[part]) : std::to_string(part));
}

/// Converts a channel of a colour in [0, 1] between sRGB, as in PLY, OBJ and VTP, and linear light, as in COLOR_0 of glTF (IEC 61966-2-1).
inline double linear_of_srgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
inline double srgb_of_linear(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

/// The content of a file beyond positions and triangles.
struct Attributes {
    std::vector<VertexColumn> columns = {};   // values, and perhaps normals nx, ny, nz, which writers compute anew
    std::string obj = {};                     // the text of an OBJ file; empty for other formats
    std::vector<long> face_lines = {};        // the line of each triangle in that text
};

}   // namespace meshfolio
