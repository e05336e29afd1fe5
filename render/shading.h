/// @file
/// The colour of what a pixel sees.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "fragments.h"
#include "outline.h"
#include "scene.h"
#include "srgb.h"

namespace render {

/// The colours of a surface in linear light, opaque.
struct Palette {
    static constexpr int steps = 1024;

    glm::vec3 plain, undefined;
    std::vector<float> red, green, blue;   // the colour map at steps + 1 places

    explicit Palette(const DrawOptions& options);
};

/// How one view is shaded.
struct ShadingStyle {
    const DrawOptions& options;
    const Palette& palette;
    bool has_values;
    std::array<glm::vec3, 3> lights;               // directions along the axes of the projection
    float towards_viewer;                          // +1 or −1 along the depth axis
    float isoline_scale = 0, isoline_offset = 0;   // isolines where map position · scale + offset is whole; scale 0: none

    ShadingStyle(const Scene& scene, const DrawOptions& options, const Palette& palette, const Placement& placement);
};

/// Gives every fragment its colour. @param ribbons  those of the projection; their numbers follow those of the triangles
void shade(const ProjectedScene& scene, std::span<const Ribbon> ribbons, const ShadingStyle& style, Fragments& fragments);

/// How strongly a surface with this unit normal (right, up, towards the viewer) is lit, 0 to 1; neutral in colour.
float lit(const glm::vec3& normal);

}   // namespace render
