/// @file
/// CIELAB (CIE 1976, white D65): the space in which colour maps are drawn up, because equal steps in it look nearly equal.
#pragma once

#include <glm/vec3.hpp>

#include "scene/image.h"

namespace render {

/// (L*, a*, b*): lightness 0–100, green to red, blue to yellow.
glm::dvec3 lab_of(Rgba color);
/// The nearest colour of the sRGB cube, channel by channel.
Rgba rgba_of_lab(const glm::dvec3& lab);

}   // namespace render
