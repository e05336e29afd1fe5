#include "run/one_mesh/terminal_picture.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "base/base64.h"
#include "base/errors.h"
#include "png/png.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

using render::Image;
using render::Rgba;

constexpr int lines_of_text = 2, cell_width = 8, cell_height = 16;   // [pixels] of a terminal that does not tell
constexpr int largest_picture = 1600;                                // [pixels], so that it crosses a network in a moment

/// Returns the parts of kitty's protocol: PNG (f=100), shown at the cursor (a=T), without replies (q=2), more parts to come (m=1).
/// sw.kovidgoyal.net/kitty/graphics-protocol
std::string kitty_picture(const std::string& png) {
    constexpr std::size_t part = 4096;
    const std::string data = base64(png);
    std::string text;
    for (std::size_t begin = 0; begin < data.size(); begin += part) {
        const bool more = begin + part < data.size();
        text +=
            std::string("\x1b_G") + (begin == 0 ? "a=T,f=100,q=2," : "") + (more ? "m=1;" : "m=0;") + data.substr(begin, part) + "\x1b\\";
    }
    return text + "\n";
}

/// Returns an inline image (iterm2.com/documentation-images.html). Its width is in columns, as pixels are not those of a fine screen.
std::string iterm_picture(const std::string& png, int columns) {
    return "\x1b]1337;File=inline=1;size=" + std::to_string(png.size()) + ";width=" + std::to_string(columns) + ":" + base64(png) + "\a\n";
}

int squared_distance(Rgba a, const std::array<int, 3>& b) {
    const int r = a.r - b[0], g = a.g - b[1], blue = a.b - b[2];
    return r * r + g * g + blue * blue;
}

/// Returns the index of the nearest colour of xterm's cube of 6 × 6 × 6 colours (from 16 on) and its 24 greys (from 232 on).
int nearest_of_256(Rgba color) {
    constexpr std::array<int, 6> levels{0, 95, 135, 175, 215, 255};
    const auto nearest = [&](int channel) { return channel < 48 ? 0 : channel < 115 ? 1 : (channel - 35) / 40; };
    const int r = nearest(color.r), g = nearest(color.g), b = nearest(color.b);
    const auto level = [&](int i) { return levels[static_cast<std::size_t>(i)]; };
    const int grey = std::clamp(((color.r + color.g + color.b) / 3 - 3) / 10, 0, 23), light = 8 + 10 * grey;
    const bool is_grey = squared_distance(color, {light, light, light}) < squared_distance(color, {level(r), level(g), level(b)});
    return is_grey ? 232 + grey : 16 + 36 * r + 6 * g + b;
}

/// Returns the end of an escape sequence that sets the colour of the character (3) or of its ground (4); "39" or "49" for transparent.
std::string color_code(char layer, Rgba color, bool all_colors) {
    constexpr int opaque = 128;
    if (color.a < opaque) return layer + std::string("9");
    if (!all_colors) return layer + ("8;5;" + std::to_string(nearest_of_256(color)));
    return layer + ("8;2;" + std::to_string(color.r) + ";" + std::to_string(color.g) + ";" + std::to_string(color.b));
}

std::string half_blocks(const Image& image, bool all_colors) {
    std::string text;
    for (int y = 0; y < image.height; y += 2) {
        std::string last;
        for (int x = 0; x < image.width; ++x) {
            Rgba upper = image.at(x, y), lower = y + 1 < image.height ? image.at(x, y + 1) : Rgba{0, 0, 0, 0};
            const bool only_lower = upper.a < 128 && lower.a >= 128, nothing = upper.a < 128 && lower.a < 128;
            if (only_lower) std::swap(upper, lower);
            const std::string code = color_code('3', upper, all_colors) + ";" + color_code('4', lower, all_colors);
            if (code != last) text += "\x1b[" + code + "m";
            text += nothing ? " " : only_lower ? "\u2584" : "\u2580";   // lower and upper half block
            last = code;
        }
        text += "\x1b[0m\n";
    }
    return text;
}

bool starts_with_one_of(const std::string& word, std::initializer_list<std::string_view> starts) {
    return std::ranges::any_of(starts, [&](std::string_view start) { return word.starts_with(start); });
}

}   // namespace

// Multiplexers pass no pictures on. tmux turns 24-bit colours into what its terminal has; screen misreads them. KITTY_WINDOW_ID may be left
// from outside of another program's terminal. WezTerm has kitty's protocol only on request. SSH passes TERM, and often LC_TERMINAL, but
// not COLORTERM: then 256 colours, which all terminals of today show, are safe, and 24-bit ones might be read as other codes.
TerminalGraphics terminal_graphics(bool is_terminal) {
    const std::string kind = environment("TERM"), program = environment("TERM_PROGRAM"), colors = environment("COLORTERM");
    const bool in_tmux = !environment("TMUX").empty() || kind.starts_with("tmux");
    const bool in_screen = !in_tmux && (!environment("STY").empty() || kind.starts_with("screen"));
    if (in_screen) return TerminalGraphics::colors_256;
    if (is_terminal && !in_tmux) {
        const bool of_kitty = starts_with_one_of(kind, {"xterm-kitty", "xterm-ghostty"}) || program == "ghostty";
        if (of_kitty || (program.empty() && !environment("KITTY_WINDOW_ID").empty())) return TerminalGraphics::kitty;
        if (program == "iTerm.app" || program == "WezTerm" || environment("LC_TERMINAL") == "iTerm2") return TerminalGraphics::iterm;
    }
    const bool has_all = colors == "truecolor" || colors == "24bit" || kind.ends_with("-direct") || !environment("TMUX").empty();
    return has_all || starts_with_one_of(kind, {"xterm-kitty", "xterm-ghostty", "alacritty", "foot", "wezterm"})
               ? TerminalGraphics::true_colors
               : TerminalGraphics::colors_256;
}

TerminalRoom terminal_room() {
    if (const std::string why = why_no_colors(STDOUT_FILENO); !why.empty())
        throw UsageError("a picture in the terminal needs colours, but " + why, "draw into a file with render … -o FILE.png");
    return {terminal_size(STDOUT_FILENO), terminal_graphics(::isatty(STDOUT_FILENO) == 1)};
}

std::pair<int, int> picture_pixels(const TerminalRoom& room) {
    const auto& [columns, rows, width, height] = room.size;
    const int rows_left = std::max(1, rows - lines_of_text);
    if (room.is_coarse()) return {columns, 2 * rows_left};
    const int all_width = width > 0 ? width : columns * cell_width, all_height = height > 0 ? height : rows * cell_height;
    return {std::clamp(all_width, 1, largest_picture), std::clamp(all_height * rows_left / rows, 1, largest_picture)};
}

std::string terminal_picture(const Image& image, const TerminalRoom& room) {
    const auto [width, height] = picture_pixels(room);
    const double scale = std::min({1.0, double(width) / image.width, double(height) / image.height});
    const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
    const Image fitting = scale < 1 ? render::shrink(image, scaled(image.width), scaled(image.height)) : image;
    if (room.is_coarse()) return half_blocks(fitting, room.graphics == TerminalGraphics::true_colors);
    const std::string png = render::encode_png(fitting);
    if (room.graphics == TerminalGraphics::kitty) return kitty_picture(png);
    return iterm_picture(png, std::max(1, fitting.width * room.size.columns / width));
}

}   // namespace meshfolio::run
