/// @file
/// Pictures of meshes: the entry point of the renderer.
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

/// A surface to draw, which refers to data of the caller. Coordinates may be huge, tiny or far off: they are centred and scaled in double.
/// Triangles with a corner that is not finite or an index out of range are left out.
struct Surface {
    std::span<const glm::dvec3> positions;
    std::span<const glm::ivec3> triangles;   // counter-clockwise seen from outside
    std::span<const double> values = {};     // one a vertex, interpolated before they are coloured; empty: one plain colour
};

/// The mapping of values to colours.
struct ValueRange {
    const Colormap* colormap = nullptr;   // null: viridis
    double low = 0, high = 1;             // ends of the map; values beyond are clamped
    bool logarithmic = false;             // positions by the logarithm; low > 0, and lower values count as low

    /// Returns the position of a value in the map: 0 at the low end, 1 at the high end; below 0 or above 1 outside of the range, but never
    /// below 0 in a logarithmic one. Not finite if the ends are equal.
    double position(double value) const;
};

struct DrawOptions {
    int width = 1024, height = 1024;
    double fill = 0.92;                // share of the shorter side that the largest extent takes
    std::optional<Frame> frame = {};   // default: views along the axes share one, any other has its own, fitted with `fill`
    ValueRange range = {};
    Rgba surface_color{238, 237, 234, 255};      // without values
    Rgba undefined_color{198, 198, 198, 255};    // of values that are NaN; hatched with shading
    Rgba background{255, 255, 255, 255};         // alpha 0: transparent
    bool shading = true;                         // smooth, two-sided; false: flat colours
    bool face_colors_from_id = false;            // triangle number + 1 as R·65536 + G·256 + B, modulo 2²⁴, unshaded (for checks)
    bool occlusion = true;                       // darkens hollows and contacts; with shading only
    bool edges = false;                          // thin lines along the edges of triangles
    double isoline_spacing = 0;                  // thin lines at the multiples of this value; 0: none
    std::span<const int> marked_vertices = {};   // get a ring if they are visible
    bool backface_tint = true;                   // a tint or hatch on the back of an open surface
    int samples = 0;                             // per pixel: 1, 4 or 16; 0: 4 for views along the axes, else 16
};

/// Returns the frame in which draw_views() draws a view.
Frame frame_of(const Surface& surface, const View& view, const DrawOptions& options);

/// Large triangles cover each other so often that drawing them would take minutes or gigabytes.
struct TooMuchOverdraw : std::runtime_error {
    TooMuchOverdraw() : std::runtime_error("too many large triangles lie over each other") {}
};

/// Returns one picture of width × height for each view, in order; only the background if no triangle can be drawn. Draws in parallel, with
/// equal bytes for any number of threads.
/// @throws TooMuchOverdraw if triangles larger than 63 pixels, not hidden, cover the picture some thousand times
/// @throws std::invalid_argument if the picture's size or number of samples is not possible, or the number of values is wrong
std::vector<Image> draw_views(const Surface& surface, std::span<const View> views, const DrawOptions& options);

}   // namespace render
