/// @file
/// Colour bars: the legends of figures.
#pragma once

#include <string>
#include <vector>

#include "draw_mesh.h"
#include "sheet/drawing.h"

namespace render {

struct ColorBar {
    ValueRange range = {};
    std::string quantity = {};   // "mean curvature H"
    std::string unit = {};       // "1/length"; may be empty
    double clipped_below = 0;    // share of the values outside the range, printed if > 0
    double clipped_above = 0;
    double isoline_spacing = 0;   // lines over the colours at the multiples of this value; 0: none
    bool has_undefined = false;   // adds a swatch in `undefined_color` for NaN
    Rgba undefined_color{198, 198, 198, 255};
    /// Shares of the values in equal bins over [low, high], drawn above the bar; empty: none. Heights are the square roots of the shares,
    /// so that rare values stay visible beside frequent ones.
    std::vector<double> histogram = {};
};

/// Returns the height of a colour bar with its title, histogram, ticks and notes, if it has them [pixels]. @param em  text size [pixels]
int color_bar_height(const ColorBar& bar, double em);

/// Adds a colour bar in the columns [left, left + width) from the row `top` down.
void add_color_bar(Drawing& drawing, const ColorBar& bar, int left, int top, int width, double em, Rgba ink);

/// Returns the width of a small bar for the line of a label: low end, colours, high end with unit, share of the values beyond [pixels].
double small_bar_width(const ColorBar& bar, double em);

/// Adds a small bar from the column `left` on, centred on the row `middle`.
void add_small_bar(Drawing& drawing, const ColorBar& bar, double left, double middle, double em, Rgba ink);

}   // namespace render
