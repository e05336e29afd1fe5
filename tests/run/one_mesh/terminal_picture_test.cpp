#include "run/one_mesh/terminal_picture.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "base/base64.h"
#include "base/errors.h"
#include "png/png.h"

using namespace meshfolio;
using namespace meshfolio::run;
using render::Image;
using render::Rgba;

namespace {

constexpr Rgba nothing{0, 0, 0, 0};

Image random_image(int width, int height, unsigned seed, bool transparent) {
    std::mt19937 random(seed);
    Image image(width, height);
    const auto channel = [&] { return static_cast<std::uint8_t>(random() % 256); };
    for (Rgba& pixel : image.pixels) pixel = transparent && random() % 3 == 0 ? nothing : Rgba{channel(), channel(), channel(), 255};
    return image;
}

/// Returns the colour of index 16 to 255 of xterm.
Rgba xterm_color(int index) {
    const auto level = [](int i) { return static_cast<std::uint8_t>(i == 0 ? 0 : 55 + 40 * i); };
    if (index >= 232)
        return Rgba(static_cast<std::uint8_t>(8 + 10 * (index - 232)), static_cast<std::uint8_t>(8 + 10 * (index - 232)),
                    static_cast<std::uint8_t>(8 + 10 * (index - 232)), 255);
    return {level((index - 16) / 36), level((index - 16) / 6 % 6), level((index - 16) % 6), 255};
}

/// Reads the pixels as a terminal would: "ESC [ numbers m" sets colours, "▀", "▄" and spaces are two pixels.
std::vector<std::vector<Rgba>> pixels_of(const std::string& text) {
    std::vector<std::vector<Rgba>> rows;
    Rgba ink, ground;
    std::vector<Rgba> upper, lower;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == '\n') {
            rows.push_back(upper), rows.push_back(lower);
            upper.clear(), lower.clear(), ++i;
        } else if (text[i] == '\x1b') {
            const std::size_t end = text.find('m', i);
            std::vector<int> codes;
            std::istringstream numbers(text.substr(i + 2, end - i - 2));
            for (std::string word; std::getline(numbers, word, ';');) codes.push_back(std::stoi(word));
            for (std::size_t k = 0; k < codes.size();) {
                Rgba& layer = codes[k] / 10 == 3 ? ink : ground;
                const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(codes.at(at)); };
                if (codes[k] == 0) {
                    ink = ground = nothing, ++k;
                } else if (codes[k] % 10 == 9) {
                    layer = nothing, ++k;
                } else if (codes.at(k + 1) == 5) {
                    layer = xterm_color(codes.at(k + 2)), k += 3;
                } else {
                    layer = {byte(k + 2), byte(k + 3), byte(k + 4), 255}, k += 5;
                }
            }
            i = end + 1;
        } else if (text[i] == ' ') {
            upper.push_back(ground), lower.push_back(ground), ++i;
        } else {
            const bool is_upper = text.substr(i, 3) == "▀";
            EXPECT_TRUE(is_upper || text.substr(i, 3) == "▄");
            upper.push_back(is_upper ? ink : ground), lower.push_back(is_upper ? ground : ink), i += 3;
        }
    }
    return rows;
}

TerminalRoom room_of(TerminalGraphics graphics, int columns = 80, int rows = 24, int width = 0, int height = 0) {
    return {{columns, rows, width, height}, graphics};
}

/// Variables of the environment while a test runs; all others that matter are unset.
class Environment {
public:
    explicit Environment(const std::map<std::string, std::string>& variables) {
        for (const char* name : {"TERM", "TERM_PROGRAM", "COLORTERM", "TMUX", "STY", "KITTY_WINDOW_ID", "LC_TERMINAL", "NO_COLOR",
                                 "CLICOLOR", "CLICOLOR_FORCE", "COLUMNS", "LINES"}) {
            if (const char* old = getenv(name)) before_[name] = old;
            unsetenv(name);
            names_.emplace_back(name);
        }
        for (const auto& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
    }
    ~Environment() {
        for (const std::string& name : names_) unsetenv(name.c_str());
        for (const auto& [name, value] : before_) setenv(name.c_str(), value.c_str(), 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::map<std::string, std::string> before_;
    std::vector<std::string> names_;
};

TEST(TerminalPicture, HalfBlocksReadBackAreThePicture) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 4}, std::pair{80, 44}, std::pair{13, 9}})
        for (const bool transparent : {false, true}) {
            const Image image = random_image(width, height, 1, transparent);
            const auto seen = pixels_of(terminal_picture(image, room_of(TerminalGraphics::true_colors)));
            ASSERT_EQ(seen.size(), static_cast<std::size_t>(height + height % 2));
            for (int y = 0; y < static_cast<int>(seen.size()); ++y) {
                ASSERT_EQ(seen[static_cast<std::size_t>(y)].size(), static_cast<std::size_t>(width));
                for (int x = 0; x < width; ++x)
                    ASSERT_EQ(seen[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)], y < height ? image.at(x, y) : nothing)
                        << x << ", " << y;
            }
        }
}

// No colour of xterm's 240 fixed ones is nearer by more than rounding of the grey.
TEST(TerminalPicture, TakesTheNearestOf256Colours) {
    const Image image = random_image(80, 44, 2, false);
    const auto seen = pixels_of(terminal_picture(image, room_of(TerminalGraphics::colors_256)));
    const auto distance = [](Rgba a, Rgba b) { return std::hypot(a.r - b.r, a.g - b.g, a.b - b.b); };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            double least = 1e9;
            for (int index = 16; index < 256; ++index) least = std::min(least, distance(image.at(x, y), xterm_color(index)));
            ASSERT_LE(distance(image.at(x, y), seen[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]), least + 1)
                << x << ", " << y;
        }
}

TEST(TerminalPicture, FitsTheRoomAndKeepsItsShape) {
    for (const TerminalGraphics graphics : {TerminalGraphics::true_colors, TerminalGraphics::colors_256}) {
        const auto rows = pixels_of(terminal_picture(Image(400, 100, {9, 200, 30, 255}), room_of(graphics, 40, 30)));
        EXPECT_EQ(rows.size(), 10U);
        EXPECT_EQ(rows[0].size(), 40U);
    }
    EXPECT_EQ(picture_pixels(room_of(TerminalGraphics::true_colors, 80, 24)), std::pair(80, 44));
    EXPECT_EQ(picture_pixels(room_of(TerminalGraphics::true_colors, 1, 1)), std::pair(1, 2));
    EXPECT_EQ(picture_pixels(room_of(TerminalGraphics::kitty, 80, 24, 800, 480)), std::pair(800, 440));
    EXPECT_EQ(picture_pixels(room_of(TerminalGraphics::kitty, 80, 24)), std::pair(640, 352));
    EXPECT_LE(picture_pixels(room_of(TerminalGraphics::iterm, 400, 100, 8000, 4000)).first, 1600);
}

TEST(TerminalPicture, KittyGetsAPngInPartsOf4096) {
    const Image image = random_image(300, 200, 3, true);
    const std::string text = terminal_picture(image, room_of(TerminalGraphics::kitty, 80, 24, 800, 480));
    const std::regex part("\x1b_G(a=T,f=100,q=2,)?m=([01]);([A-Za-z0-9+/=]*)\x1b\\\\");
    std::string data;
    std::size_t parts = 0, bytes = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), part), end; it != end; ++it, ++parts) {
        const std::smatch& found = *it;
        EXPECT_EQ(found[1].matched, parts == 0);
        EXPECT_LE(found[3].length(), 4096);
        EXPECT_EQ(found[2] == "0", std::next(it) == end);
        bytes += static_cast<std::size_t>(found.length());
        data += found[3];
    }
    EXPECT_GT(parts, 2U);
    EXPECT_EQ(bytes + 1, text.size());   // nothing between the parts; a line end
    const auto shown = render::decode_png(from_base64(data));
    ASSERT_TRUE(shown);
    EXPECT_TRUE(shown->pixels == image.pixels);
}

TEST(TerminalPicture, ItermGetsOneInlinePng) {
    const Image image = random_image(400, 200, 4, false);
    const std::string text = terminal_picture(image, room_of(TerminalGraphics::iterm, 80, 24, 800, 480));
    const std::size_t colon = text.find(':');
    const std::string png = from_base64(text.substr(colon + 1, text.size() - colon - 3));
    EXPECT_EQ(text.substr(0, colon), "\x1b]1337;File=inline=1;size=" + std::to_string(png.size()) + ";width=40");
    EXPECT_TRUE(text.ends_with("\a\n"));
    ASSERT_TRUE(render::decode_png(png));
}

TEST(TerminalGraphicsOf, FollowTheEnvironment) {
    using enum TerminalGraphics;
    const auto graphics = [](const std::map<std::string, std::string>& variables, bool is_terminal = true) {
        const Environment environment(variables);
        return terminal_graphics(is_terminal);
    };
    EXPECT_EQ(graphics({{"TERM", "xterm-kitty"}}), kitty);   // also over SSH
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"KITTY_WINDOW_ID", "1"}}), kitty);
    EXPECT_EQ(graphics({{"TERM", "xterm-ghostty"}, {"TERM_PROGRAM", "ghostty"}}), kitty);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "WezTerm"}, {"COLORTERM", "truecolor"}}), iterm);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "iTerm.app"}}), iterm);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"LC_TERMINAL", "iTerm2"}}), iterm);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}}), colors_256);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"COLORTERM", "truecolor"}}), true_colors);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"COLORTERM", "24bit"}}), true_colors);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"COLORTERM", "yes"}}), colors_256);
    EXPECT_EQ(graphics({{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "vscode"}, {"COLORTERM", "truecolor"}, {"KITTY_WINDOW_ID", "1"}}),
              true_colors);
    // Multiplexers, begun in a terminal that has more.
    EXPECT_EQ(graphics({{"TERM", "tmux-256color"}, {"TMUX", "/tmp/t"}, {"TERM_PROGRAM", "tmux"}, {"KITTY_WINDOW_ID", "1"}}), true_colors);
    EXPECT_EQ(graphics({{"TERM", "screen"}, {"TMUX", "/tmp/t"}, {"LC_TERMINAL", "iTerm2"}}), true_colors);
    EXPECT_EQ(graphics({{"TERM", "screen.xterm-256color"}, {"STY", "1.pts"}, {"COLORTERM", "truecolor"}}), colors_256);
    EXPECT_EQ(graphics({{"TERM", "tmux-256color"}}), colors_256);   // over SSH
    // A pager takes colours, but no pictures.
    EXPECT_EQ(graphics({{"TERM", "xterm-kitty"}}, false), true_colors);
    EXPECT_EQ(graphics({{"TERM_PROGRAM", "iTerm.app"}}, false), colors_256);
}

TEST(TerminalRoomOf, RefusesOutputWithoutColoursInPlainWords) {
    ::testing::internal::CaptureStdout();   // into a file
    const auto refused = [](const std::map<std::string, std::string>& variables) -> std::string {
        const Environment environment(variables);
        try {
            terminal_room();
        } catch (const UsageError& error) {
            return error.what();
        }
        return "";
    };
    const std::string start = "a picture in the terminal needs colours, but ", end = "; draw into a file with render … -o FILE.png";
    EXPECT_EQ(refused({{"TERM", "xterm-kitty"}}), start + "the output is no terminal" + end);
    EXPECT_EQ(refused({{"NO_COLOR", "1"}, {"CLICOLOR_FORCE", "1"}}), start + "NO_COLOR is set" + end);
    EXPECT_EQ(refused({{"CLICOLOR_FORCE", "0"}}), start + "the output is no terminal" + end);
    EXPECT_EQ(refused({{"CLICOLOR_FORCE", "1"}}), "");
    const Environment environment({{"CLICOLOR_FORCE", "1"}, {"COLUMNS", "100"}, {"LINES", "40"}});
    EXPECT_EQ(terminal_room().size.columns, 100);
    EXPECT_EQ(terminal_room().size.rows, 40);
    EXPECT_TRUE(terminal_room().is_coarse());
    ::testing::internal::GetCapturedStdout();
}

}   // namespace
