/// @file
/// CIELAB (CIE 1976, white D65): the space in which colour maps are drawn up, because equal steps in it look nearly equal; and how
/// far apart two colours look in it. About 1 is just seen side by side.
#pragma once

#include <glm/vec3.hpp>

#include "scene/image.h"

namespace render {

/// (L*, a*, b*): lightness 0–100, green to red, blue to yellow.
glm::dvec3 lab_of(Rgba color);
/// The nearest colour of the sRGB cube, channel by channel.
Rgba rgba_of_lab(const glm::dvec3& lab);

/// CIEDE2000 (Sharma, Wu, Dalal 2005), with kL = kC = kH = 1.
double delta_e_2000(const glm::dvec3& a, const glm::dvec3& b);

}   // namespace render
