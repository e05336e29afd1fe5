/// @file
/// Isolines as lines, for drawings that are not made of pixels.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "draw_mesh.h"

namespace render {

/// Returns the isolines at the multiples of options.isoline_spacing in the picture that draw_views() makes of one view: polylines in
/// pixels from its upper left corner, only where the surface is visible. Closed lines end at their first point. Equal for any number of
/// threads.
std::vector<std::vector<glm::dvec2>> visible_isolines(const Surface& surface, const View& view, const DrawOptions& options);

}   // namespace render
