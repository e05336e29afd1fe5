/// @file
/// Our indices (int, as in the matrices of a mesh) as indices of a std::vector.
#pragma once

#include <cstddef>

namespace meshfolio {

/// Returns the index as std::size_t; it must not be negative.
constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }

}   // namespace meshfolio
