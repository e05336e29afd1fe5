/// @file
/// Text for a terminal: wrapped at its width, and coloured unless its user objects. Pipes and files get the plain text. Descriptors: 1 is
/// standard output, 2 standard error.
#pragma once

#include <string>

namespace meshfolio {

enum class Ink { bold = 1, dim = 2, red = 31, green = 32, yellow = 33 };   // "select graphic rendition", ECMA-48

/// Returns why text on the descriptor has no colours, such as "NO_COLOR is set"; "" if it has. None has colours if NO_COLOR is set; else
/// all have if CLICOLOR_FORCE is set and not 0; else a terminal has unless TERM is empty or "dumb", or CLICOLOR is 0 (no-color.org,
/// bixense.com/clicolors).
std::string why_no_colors(int descriptor);

/// Returns the text in escape sequences of this colour, or unchanged if the descriptor is to have no colours.
std::string inked(Ink ink, const std::string& text, int descriptor = 1);

/// Returns the text with its numbers in bold, or unchanged if the descriptor is to have no colours.
std::string with_bold_numbers(const std::string& text, int descriptor);

struct TerminalSize {
    int columns = 80, rows = 24;
    int width = 0, height = 0;   // [pixels]; 0: unknown
};

/// Returns the size of the terminal, else that of the variables COLUMNS and LINES, else 80 × 24 characters.
TerminalSize terminal_size(int descriptor);
/// Returns the number of columns of the terminal, else the variable COLUMNS, else 80.
int terminal_width(int descriptor);

/// Returns the text with each line wrapped between words at `width` columns (code points). Continuations are indented to the line's last
/// table column (a part after two spaces), in prose two columns further than the line. A word longer than a line, such as a path, stays
/// whole.
std::string wrapped(const std::string& text, int width);

/// Returns the text wrapped at the width of the terminal, or unchanged if the descriptor is not a terminal.
std::string for_terminal(const std::string& text, int descriptor = 1);

/// Returns the text if it has at most `columns` code points, else its first words and "…", together at most `columns`. A first word that is
/// too long is cut.
std::string shortened(const std::string& text, int columns);

}   // namespace meshfolio
