/// @file
/// Our indices (int, as in the matrices of a mesh) as indices of a std::vector.
#pragma once

#include <cstddef>

namespace meshfolio {

/// Converts an index, which must not be negative.
constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }

}   // namespace meshfolio
