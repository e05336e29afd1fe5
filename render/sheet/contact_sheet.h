/// @file
/// Pictures put together: title, equally large views with their names, colour bar.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw_mesh.h"
#include "scene/image.h"

namespace render {

/// The legend of a figure.
struct ColorBar {
    ValueRange range = {};
    std::string quantity = {};   // "mean curvature H"
    std::string unit = {};       // "1/length"; may be empty
    double clipped_below = 0;    // share of the values outside the range, printed when > 0
    double clipped_above = 0;
    double isoline_spacing = 0;   // lines are drawn over the colours; 0: none
    bool has_undefined = false;   // adds a swatch for NaN in `undefined_color`
    Rgba undefined_color{198, 198, 198, 255};
    /// Shares of the values in equal bins over [low, high], drawn above the bar with heights as their square roots, so that a rare
    /// value stays visible beside a frequent one; empty: none.
    std::vector<double> histogram = {};
};

/// Views of one mesh, three in a line, each with its name below; the six 2 × 3: +x +y +z over −x −y −z. Or of several meshes side by side:
/// the pictures of one view are a group, with half the gap inside and one name.
struct ContactSheet {
    std::string title = {};
    std::string subtitle = {};   // mesh, counts, settings
    std::vector<std::string> view_names = {};
    std::vector<Image> pictures = {};   // one a view, all of one size
    std::optional<ColorBar> color_bar = {};
    int cell = 0;                                         // pixels of one view in the sheet; 0: as the pictures are
    int columns = 0;                                      // pictures in a line, in their own order; 0: as above
    double em = 0;                                        // text size; 0: by the width
    std::vector<std::string> heads = {}, subheads = {};   // of each mesh of a group, above the first line
    Rgba background{255, 255, 255, 255};
};

Image compose(const ContactSheet& sheet);

/// Round ticks (1, 2, 2.5 or 5 times a power of ten) that lie in [low, high], about `wanted` of them; used by the colour bar.
std::vector<double> round_ticks(double low, double high, int wanted);

}   // namespace render
