/// @file
/// Colour maps. A new one is one entry of the table in colormap.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/image.h"

namespace render {

struct Colormap {
    std::string_view name;
    std::string_view kind;   // "sequential", "diverging", "cyclic" (its ends are one colour)
    std::string_view description;
    std::span<const Rgba> stops;   // equally spaced in [0, 1], interpolated linearly
};

std::span<const Colormap> colormap_list();
/// @throws std::invalid_argument listing the known names
const Colormap& colormap_named(const std::string& name);

/// Colour at t, clamped to [0, 1].
Rgba color_at(const Colormap& map, double t);

}   // namespace render
