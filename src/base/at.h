/// @file
/// Vertices, faces and edges are counted by int; the elements of a std::vector are not.
#pragma once

#include <cstddef>

namespace meshfolio {

constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }

}   // namespace meshfolio
