/// @file
/// The colours that a user wants.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "color/colormap.h"

namespace meshfolio::run {

struct ColorChoice {
    std::string name = {};                                  // of a bundled map, or as given; empty: that of the field
    std::shared_ptr<const render::Colormap> own_map = {};   // reversed, or read from a file; null: bundled
    std::string warning = {};                               // says why the map is not perceptually uniform; empty: it is
    std::optional<std::pair<double, double>> range = {};    // nothing: without outliers
};

/// Returns the colour map of a name in upper or lower case, reversed if "_r" follows the name, or else the map of a file: rows r,g,b or
/// t,r,g,b of text, or the JSON of ParaView with RGBPoints. Rows without t are equally spaced. Channels are from 0 to 1, or from 0 to 255
/// if one of them exceeds 1.
/// @throws UsageError for a word that is neither name nor file; InputError for a file that is no colour map
ColorChoice colormap_choice(const std::string& name_or_file);

}   // namespace meshfolio::run
