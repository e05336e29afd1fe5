/// @file
/// Meshes to pictures: the one way in. Draws triangles with per-vertex values from any of the six views.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "color/colormap.h"
#include "scene/camera.h"
#include "scene/image.h"

namespace render {

/// A surface to draw; nothing is owned. Coordinates may be huge, tiny or far off: they are centred and scaled in double
/// before they become float. Triangles with a corner that is not finite or an index out of range are left out.
struct Surface {
    std::span<const glm::dvec3> positions;
    std::span<const glm::ivec3> triangles;   // counter-clockwise seen from outside
    std::span<const double> values = {};     // one a vertex, interpolated and coloured per sample; empty: one plain colour
};

/// How values become colours.
struct ValueRange {
    const Colormap* colormap = nullptr;
    double low = 0, high = 1;   // ends of the map; values beyond are clamped
    bool logarithmic = false;   // equal ratios are equally far apart; low > 0, and what is below counts as low

    /// Where a value lies: 0 at the low end, 1 at the high one. Not finite where the ends are equal.
    double position(double value) const;
};

struct DrawOptions {
    int width = 1024, height = 1024;
    double fill = 0.92;                // share of the shorter side taken by the largest extent
    std::optional<Frame> frame = {};   // default: views along the axes share one, any other has its own, fitted with `fill`
    ValueRange range = {};
    Rgba surface_color{238, 237, 234, 255};      // where there are no values
    Rgba undefined_color{198, 198, 198, 255};    // where a value is NaN; hatched with shading
    Rgba background{255, 255, 255, 255};         // alpha 0: transparent
    bool shading = true;                         // smooth, two-sided; false: flat colours
    bool face_colors_from_id = false;            // triangle number + 1 as R·65536 + G·256 + B, modulo 2²⁴, unshaded (for checks)
    bool occlusion = true;                       // hollows and contacts are darkened; with shading only
    bool edges = false;                          // thin triangle edges
    double isoline_spacing = 0;                  // thin lines where the value is a multiple of this; 0: none
    std::span<const int> marked_vertices = {};   // ringed where they are seen
    bool backface_tint = true;                   // the back of an open surface is told apart
    int samples = 0;                             // per pixel: 1, 4 or 16; 0: 4 along the axes, where views come in sixes, else 16
};

/// Large triangles cover each other so often that drawing them would take minutes or gigabytes.
struct TooMuchOverdraw : std::runtime_error {
    TooMuchOverdraw() : std::runtime_error("too many large triangles lie over each other") {}
};

/// Returns one picture a view, in order; drawn in parallel, same bytes for any number of threads.
/// @throws TooMuchOverdraw where triangles larger than 63 pixels cover the picture some thousand times and are not hidden
std::vector<Image> draw_views(const Surface& surface, std::span<const View> views, const DrawOptions& options);

}   // namespace render
