#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/image.h"

namespace render {

/// A colour map; all are in the table in colormap.cpp.
struct Colormap {
    std::string name;
    std::string kind;   // "sequential", "diverging" or "cyclic" (both ends have one colour)
    std::string description;
    std::vector<Rgba> stops;   // equally spaced in [0, 1], with linear interpolation between
};

/// Returns all colour maps, "viridis" first.
std::span<const Colormap> colormap_list();
/// Returns the colour map of this name in upper or lower case, such as "viridis"; also "gray" and "parula". Null for another name.
const Colormap* find_colormap(std::string_view name);
/// Returns the colour map that find_colormap() finds. @throws std::invalid_argument for another name, with the known ones
const Colormap& colormap_named(const std::string& name);

/// Returns the colour at t, mixed from the two nearest stops; t is clamped to [0, 1], NaN counts as 0.
Rgba color_at(const Colormap& map, double t);

}   // namespace render
