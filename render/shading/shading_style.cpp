#include "shading/shading_style.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "color/srgb.h"

namespace render {

namespace {

/// Directions to the lights, fixed to the camera: key light from the upper left, fill light from the right, one from slightly below.
const std::array<glm::vec3, 3> light_directions{{glm::normalize(glm::vec3(-0.45F, 0.62F, 0.64F)),
                                                 glm::normalize(glm::vec3(0.80F, 0.10F, 0.59F)),
                                                 glm::normalize(glm::vec3(0.05F, -0.35F, 0.94F))}};

glm::vec3 linear_rgb(Rgba color) { return {linear_of(color.r), linear_of(color.g), linear_of(color.b)}; }

}   // namespace

Palette::Palette(const DrawOptions& options) : plain(linear_rgb(options.surface_color)), undefined(linear_rgb(options.undefined_color)) {
    for (int i = 0; i <= steps; ++i) {
        const glm::vec3 c = linear_rgb(color_at(*options.range.colormap, double(i) / steps));
        red.push_back(c.r), green.push_back(c.g), blue.push_back(c.b);
    }
}

ShadingStyle::ShadingStyle(const Scene& scene, const DrawOptions& drawn, const Palette& colors, const Placement& placement)
    : options(drawn),
      palette(colors),
      has_values(!scene.map_positions.empty()),
      towards_viewer(placement.from_below ? -1.0F : 1.0F),
      slant(placement.mirrored_x == placement.mirrored_y ? 1.0F : -1.0F) {
    const glm::vec3 axes(placement.mirrored_x ? -1 : 1, placement.mirrored_y ? -1 : 1, towards_viewer);
    for (std::size_t l = 0; l < lights.size(); ++l) lights[l] = axes * light_directions[l];
    // Isolines where the value, low + t · (high − low) for a map position t, is a multiple of the spacing.
    const double width = options.range.high - options.range.low, lines_below = options.range.low / options.isoline_spacing;
    if (!(options.isoline_spacing > 0) || !(width > 0) || !has_values) return;
    isoline_scale = static_cast<float>(width / options.isoline_spacing);
    isoline_offset = static_cast<float>(lines_below - std::floor(lines_below));
}

}   // namespace render
