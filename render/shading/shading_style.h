#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "raster/fragments.h"
#include "scene/outline.h"

namespace render {

/// Strengths of the three lights, and of the light from everywhere. Lights are neutral, so that hues do not shift, and reach a little
/// beyond the horizon (`wrap`). They add up to 0.95 where the key light falls straight, so that no colour turns white. The L* of clay is 92
/// there, 87 facing the viewer and 45 in the shade.
inline constexpr std::array<float, 3> light_strength{0.78F, 0.12F, 0.18F};
inline constexpr float ambient = 0.05F, wrap = 0.1F;

/// Least double area [square grid steps] for full trust in the normal of a rounded triangle, which is then an eighth of a pixel wide.
inline constexpr float trusted_area = 32 * 32;

/// Light on surfaces with values: brighter, so that colours facing the viewer match the colour bar, and with little contrast. Even with all
/// occlusion, colours keep 0.88 of their luminance and can be read as numbers; outlines show the form.
inline constexpr float exposure_of_values = 1.1F, light_on_values = 0.09F;

/// The back is blue-grey on plain surfaces, hatched on surfaces with values.
inline constexpr glm::vec3 back_tint{0.58F, 0.68F, 0.85F};
inline constexpr float hatch_spacing = 5, back_hatch = 0.45F, undefined_hatch = 0.35F;   // spacing in pixels, then shares of the light

inline constexpr glm::vec3 ink_color{0.012F, 0.012F, 0.016F};
inline constexpr float line_half_width = 0.45F;   // pixels on either side
inline constexpr float edge_strength = 0.55F;     // share of the light that lines along edges take
inline constexpr float smallest_meshed = 9;       // pixels; edges of smaller triangles fade, so that they do not blacken the surface
/// Least slope of isolines, in shares of the colour range per pixel: on flatter parts rounding noise would draw them.
inline constexpr float flattest_isolines = 3e-5F;
inline constexpr float closest_isolines = 6;   // pixels; closer ones fade
/// Light on ribbons: darker than the surface, above all on plain ones, to stand out on white.
inline constexpr float ribbon_light = 0.38F, plain_ribbon_light = 0.25F;

/// The colours of a surface in linear light, opaque.
struct Palette {
    static constexpr int steps = 1024;

    glm::vec3 plain, undefined;
    std::vector<float> red, green, blue;   // the colour map at steps + 1 places

    explicit Palette(const DrawOptions& options);
};

/// The shading of one view.
struct ShadingStyle {
    const DrawOptions& options;
    const Palette& palette;
    bool has_values;
    std::array<glm::vec3, 3> lights;               // directions to the lights along the axes of the projection
    float towards_viewer;                          // direction of the viewer along the depth axis: +1 or −1
    float slant;                                   // of hatches: −1 in a mirrored picture, else 1
    float isoline_scale = 0, isoline_offset = 0;   // isolines where map position · scale + offset is an integer; scale 0: none

    ShadingStyle(const Scene& scene, const DrawOptions& options, const Palette& palette, const Placement& placement);
};

/// Sets red, green and blue of every fragment; `triangle` of fragments of ribbons and far triangles is not valid afterwards. @param ribbons
/// of the projection; their numbers follow those of the triangles
void shade(const ProjectedScene& scene, std::span<const Ribbon> ribbons, const ShadingStyle& style, Fragments& fragments);

/// Interpolates normal and value of fragment i in double, for a triangle or ribbon `id` with corners that do not fit the grid.
void interpolate_exactly(const ProjectedScene& scene, std::span<const Ribbon> ribbons, std::int32_t id, const ShadingStyle& style,
                         Fragments& fragments, std::size_t i);

}   // namespace render
