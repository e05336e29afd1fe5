/// @file
/// NaN for what is undefined, infinity for what has no bound, π, and how finely doubles are rounded.
#pragma once

#include <limits>
#include <numbers>

namespace meshfolio {

using std::numbers::pi;
/// NaN: a dash in tables, grey in pictures.
inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
/// Twice the unit roundoff: in bounds of rounding, room for terms of second order.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

}   // namespace meshfolio
