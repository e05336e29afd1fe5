/// @file
/// Pictures in a terminal.
#pragma once

#include <string>
#include <utility>

#include "base/terminal.h"
#include "scene/image.h"

namespace meshfolio::run {

/// The ways to show pictures in a terminal: by the graphics protocol of kitty, by the inline images of iTerm2, or by half blocks with
/// two pixels each, in 24-bit colour or in the 256 colours of xterm.
enum class TerminalGraphics { kitty, iterm, true_colors, colors_256 };

struct TerminalRoom {
    TerminalSize size = {};
    TerminalGraphics graphics = TerminalGraphics::colors_256;
    /// True if a picture is made of characters, which are too coarse for words.
    bool is_coarse() const { return graphics == TerminalGraphics::true_colors || graphics == TerminalGraphics::colors_256; }
};

/// Returns what the variables of the environment say of the terminal.
/// @param is_terminal  false: the output is read by a pager or kept in a file
TerminalGraphics terminal_graphics(bool is_terminal);

/// Returns the room for a picture on standard output. @throws UsageError if it shows no colours
TerminalRoom terminal_room();

/// Returns the largest width and height of a picture that leaves two lines for text.
std::pair<int, int> picture_pixels(const TerminalRoom& room);

/// Returns the text that shows a picture at the left of the terminal, with a line end after it. A picture that is larger than
/// picture_pixels() is shrunk to fit. Transparent pixels show the terminal's background.
std::string terminal_picture(const render::Image& image, const TerminalRoom& room);

}   // namespace meshfolio::run
