/// @file
/// The legend under a figure: what the colours mean.
#pragma once

#include "sheet/contact_sheet.h"

namespace render {

/// Height of the legend for text of size `em`.
int color_bar_height(const ColorBar& bar, double em);

/// Draws into the columns [left, left + width) from the row `top` down.
void draw_color_bar(Image& image, const ColorBar& bar, int left, int top, int width, double em, Rgba ink);

}   // namespace render
