/// @file
/// The legend under a figure: what the colours mean.
#pragma once

#include "sheet/contact_sheet.h"

namespace render {

/// The bar of one panel, in the line of its label: low end, colours, high end with the unit, the share beyond.
double small_bar_width(const ColorBar& bar, double em);
/// Draws from `left` on, round the row `middle`.
void draw_small_bar(Image& image, const ColorBar& bar, double left, double middle, double em, Rgba ink);

/// Height of the legend for text of size `em`.
int color_bar_height(const ColorBar& bar, double em);

/// Draws into the columns [left, left + width) from the row `top` down.
void draw_color_bar(Image& image, const ColorBar& bar, int left, int top, int width, double em, Rgba ink);

}   // namespace render
