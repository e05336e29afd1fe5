/// @file
/// The visible difference of two colours; about 1 is just visible side by side.
#pragma once

#include <glm/vec3.hpp>

namespace render {

/// CIEDE2000 (Sharma, Wu, Dalal 2005) of two colours in CIELAB, with kL = kC = kH = 1.
double delta_e_2000(const glm::dvec3& a, const glm::dvec3& b);

}   // namespace render
