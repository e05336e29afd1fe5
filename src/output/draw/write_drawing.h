/// @file
/// Drawings as files: the pictures as pixels, all else as vectors, words as text in embedded fonts. Equal drawings give equal bytes.
#pragma once

#include <string>

#include "sheet/drawing.h"

namespace meshfolio::output {

/// Returns a PDF of one page of the drawing's size.
/// @param resolution  pixels of the drawing per inch @param title  of the document
std::string write_pdf(const render::Drawing& drawing, double resolution, const std::string& title);

/// Returns an SVG with its fonts inside; parameters as for write_pdf().
std::string write_svg(const render::Drawing& drawing, double resolution, const std::string& title);

/// Returns a plot or map as an SVG file of its own with the fonts of its words inside.
std::string with_fonts(std::string svg);

}   // namespace meshfolio::output
