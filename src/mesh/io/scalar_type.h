/// @file
/// The kinds of numbers that binary formats hold, and the columns of such numbers that meshes carry.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// use(zero), the zero being of the C++ type that `type` stands for.
template <class Use>
auto with_zero_of(ScalarType type, const Use& use) {
    switch (type) {
        case ScalarType::int8:
            return use(std::int8_t{});
        case ScalarType::uint8:
            return use(std::uint8_t{});
        case ScalarType::int16:
            return use(std::int16_t{});
        case ScalarType::uint16:
            return use(std::uint16_t{});
        case ScalarType::int32:
            return use(std::int32_t{});
        case ScalarType::uint32:
            return use(std::uint32_t{});
        case ScalarType::int64:
            return use(std::int64_t{});
        case ScalarType::uint64:
            return use(std::uint64_t{});
        case ScalarType::float32:
            return use(float{});
        case ScalarType::float64:
            break;
    }
    return use(double{});
}

/// Bytes in a binary file.
inline std::size_t size_of(ScalarType type) {
    return with_zero_of(type, [](auto zero) { return sizeof(zero); });
}

inline bool is_integer(ScalarType type) {
    return with_zero_of(type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
}

/// A number that begins at `raw`, in the machine's order of bytes or in the other one.
template <class T>
T value_at(const char* raw, bool swapped) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), raw, sizeof(T));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

template <class T>
T little_endian(const char* raw) {
    return value_at<T>(raw, std::endian::native == std::endian::big);
}

/// Little endian, as everything binary that we write.
template <class T>
void append_little_endian(std::string& bytes, T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

/// One number a vertex, beside its place: a channel of its colour, a quality, a curvature.
struct VertexColumn {
    std::string name;
    Vector values;                           // n, each within the range of the type; NaN: not defined
    ScalarType type = ScalarType::float64;   // as files hold it
    std::string array = {};                  // of several numbers a vertex, which this is one of; empty: it stands alone
};

/// The column of number `part` of such an array: "velocity_x", or "stress_4" where they are not three.
inline std::string component_name(const std::string& array, std::size_t part, std::size_t parts) {
    return array + "_" + (parts == 3 ? std::string(1, "xyz"[part]) : std::to_string(part));
}

/// What a file says beside positions and triangles.
struct Attributes {
    std::vector<VertexColumn> columns = {};   // those of nx, ny, nz are no values: whoever writes them computes normals anew
    std::string obj = {};                     // the text of an OBJ file; empty for other formats
    std::vector<long> face_lines = {};        // in that text, of each triangle
};

}   // namespace meshfolio
