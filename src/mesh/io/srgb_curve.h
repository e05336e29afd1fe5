/// @file
/// Channels of colours in [0, 1] between sRGB, as PLY, OBJ and VTP hold them, and linear light, as COLOR_0 of glTF does (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace meshfolio {

inline double linear_of_srgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
inline double srgb_of_linear(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

}   // namespace meshfolio
