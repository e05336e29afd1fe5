#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/image.h"

namespace render {

/// A colour map; all are in the table in colormap.cpp.
struct Colormap {
    std::string_view name;
    std::string_view kind;   // "sequential", "diverging" or "cyclic" (both ends have one colour)
    std::string_view description;
    std::span<const Rgba> stops;   // equally spaced in [0, 1], with linear interpolation between
};

/// Returns all colour maps.
std::span<const Colormap> colormap_list();
/// Returns the map "viridis", for example. @throws std::invalid_argument with the known names
const Colormap& colormap_named(const std::string& name);

/// Returns the colour at t, clamped to [0, 1]; at 0 for NaN.
Rgba color_at(const Colormap& map, double t);

}   // namespace render
