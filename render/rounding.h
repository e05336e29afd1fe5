/// @file
/// Conversions to integers.
#pragma once

#include <cmath>
#include <cstddef>

namespace render {

/// Returns i as std::size_t; i must not be negative.
constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
/// Returns the nearest integer, away from 0 on a tie.
inline int rounded(double x) { return static_cast<int>(std::lround(x)); }

}   // namespace render
