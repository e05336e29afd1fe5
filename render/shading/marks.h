/// @file
/// Rings round vertices that a picture points out.
#pragma once

#include <span>

#include "scene/scene.h"
#include "scene/view_picture.h"

namespace render {

/// Rings those of the vertices that the view sees; numbers out of range are passed over. `picture` must have heights if there are any.
void draw_marks(const ProjectedScene& scene, std::span<const int> vertices, ViewPicture& picture);

}   // namespace render
