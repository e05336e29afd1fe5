#pragma once

#include <optional>

#include "draw_mesh.h"
#include "scene/sight.h"

namespace render {

/// Returns the three-quarter view turned about the up axis to one of eight directions, 35° to either side of the horizontal axes: the usual
/// direction, unless another scores 15 % more for visible fronts and their curved parts. Up is +y, or +z if the model is symmetric along y,
/// not along z, and not flattest along z (an upright model is not symmetric along the vertical). The result depends neither on the order of
/// vertices and triangles nor on the scale.
/// @param up  the axis that is up instead
View hero_view(const Surface& surface, std::optional<Up> up = {});

/// Returns the view from the camera of `sight`, else the hero_view().
View view_of(const Sight& sight, const Surface& surface);

}   // namespace render
