/// @file
/// NaN for undefined values, infinity, π, and the rounding of doubles.
#pragma once

#include <limits>
#include <numbers>

namespace meshfolio {

using std::numbers::pi;
/// NaN: shown as a dash in tables, grey in pictures.
inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
/// Twice the unit roundoff: bounds of rounding then include terms of second order.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

}   // namespace meshfolio
