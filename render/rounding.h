/// @file
/// Integers from other numbers, in one word.
#pragma once

#include <cmath>
#include <cstddef>

namespace render {

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
inline int rounded(double x) { return static_cast<int>(std::lround(x)); }

}   // namespace render
