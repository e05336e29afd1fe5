/// @file
/// The direction that shows a mesh best, among eight.
#pragma once

#include "draw_mesh.h"

namespace render {

/// Returns the three-quarter view, turned about the up axis to one of eight directions, 35° to either side of the horizontal axes: the
/// usual one unless another shows 15 % more of fronts, and of what is curved on them. Up is +y, or +z where the model is its own mirror
/// image along y and not along z, as what stands upright is along no vertical, and is not flattest along z. Depends neither on the order of
/// vertices and triangles nor on the scale.
View hero_view(const Surface& surface);

}   // namespace render
