/// @file
/// The colour of what a pixel sees.
#pragma once

#include <span>

#include "raster/fragments.h"
#include "scene/outline.h"
#include "shading/shading_style.h"

namespace render {

/// Gives every fragment its colour. @param ribbons  those of the projection; their numbers follow those of the triangles
void shade(const ProjectedScene& scene, std::span<const Ribbon> ribbons, const ShadingStyle& style, Fragments& fragments);

}   // namespace render
