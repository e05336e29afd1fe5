/// @file
/// How a view is shaded: colours, lights and lines.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "raster/fragments.h"
#include "scene/outline.h"

namespace render {

/// Soft: each light reaches a little beyond its horizon. With the ambient part they add up to 0.95 where the key light falls straight, so
/// no colour is driven to white, and being neutral they shift no hue. Clay has an L* of 92 there, 87 facing the viewer and 45 in the shade.
inline constexpr std::array<float, 3> light_strength{0.78F, 0.12F, 0.18F};
inline constexpr float ambient = 0.05F, wrap = 0.1F;

/// Twice the area (square grid steps) from which on the rounded normal of a triangle can be trusted: an eighth of a pixel wide.
inline constexpr float trusted_area = 32 * 32;

/// Values are lit more, so that what faces the viewer is as light as the colour bar, and hardly any of the lighting shows on them: with
/// all occlusion a colour keeps 0.88 of its luminance, so that it can be read as a number. Outlines show the form.
inline constexpr float exposure_of_values = 1.1F, light_on_values = 0.09F;

/// The back of plain surfaces is blue-grey, of those with values hatched.
inline constexpr glm::vec3 back_tint{0.58F, 0.68F, 0.85F};
inline constexpr float hatch_spacing = 5, back_hatch = 0.45F, undefined_hatch = 0.35F;   // pixels; of the light

inline constexpr glm::vec3 ink_color{0.012F, 0.012F, 0.016F};
inline constexpr float line_half_width = 0.45F;   // pixels on either side
inline constexpr float edge_strength = 0.55F;     // of lines along edges: form and colours are what is looked at
inline constexpr float smallest_meshed = 9;       // pixels; lines of smaller triangles fade, lest they blacken the surface
/// Of the colour range, per pixel: parts flatter than this have no isolines, or rounding noise on a level would draw them.
inline constexpr float flattest_isolines = 3e-5F;
inline constexpr float closest_isolines = 6;   // pixels; closer ones fade
/// Ribbons are a little darker than the surface, plain ones more so, to stand out on white.
inline constexpr float ribbon_light = 0.38F, plain_ribbon_light = 0.25F;

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
    float slant;                                   // of hatches: −1 in a mirrored picture
    float isoline_scale = 0, isoline_offset = 0;   // isolines where map position · scale + offset is whole; scale 0: none

    ShadingStyle(const Scene& scene, const DrawOptions& options, const Palette& palette, const Placement& placement);
};

/// Gives every fragment its colour. @param ribbons  those of the projection; their numbers follow those of the triangles
void shade(const ProjectedScene& scene, std::span<const Ribbon> ribbons, const ShadingStyle& style, Fragments& fragments);

}   // namespace render
