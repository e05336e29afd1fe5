/// @file
/// What a terminal shows: text wrapped at its width, and colours where its user wants them. Pipes and files get neither.
#pragma once

#include <string>

namespace meshfolio {

// Where no descriptor is named, standard output is meant.

enum class Ink { bold = 1, dim = 2, red = 31, green = 32, yellow = 33 };   // "select graphic rendition", ECMA-48

/// Returns whether text for this descriptor may have colours: on a terminal that knows them unless NO_COLOR is set or CLICOLOR is 0, and
/// elsewhere if CLICOLOR_FORCE asks for them (no-color.org, bixense.com/clicolors).
bool has_colors(int descriptor);

/// Returns the text in this colour where there are colours, else as it is.
std::string inked(Ink ink, const std::string& text, int descriptor = 1);

/// Returns the text with its numbers in bold where there are colours.
std::string with_bold_numbers(const std::string& text, int descriptor);

/// Returns the columns of the terminal, else COLUMNS, else 80.
int terminal_width(int descriptor);

/// Returns the lines wrapped between words at `width` columns (code points). What goes on is indented as the last column of the line, a
/// part that two spaces set off. A word longer than a line stays whole: it may be a path.
std::string wrapped(const std::string& text, int width);

/// Returns the text wrapped at the width of the terminal; as it is where the descriptor is none.
std::string for_terminal(const std::string& text, int descriptor = 1);

/// Returns at most `columns` code points: where that cuts something off, whole words and "…".
std::string shortened(const std::string& text, int columns);

}   // namespace meshfolio
