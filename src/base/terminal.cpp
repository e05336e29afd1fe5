#include "base/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <string_view>

#include "base/number_text.h"

namespace meshfolio {

namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

bool has_colors(int descriptor) { return why_no_colors(descriptor).empty(); }

bool begins_code_point(char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }

/// Returns the number of bytes of the first `columns` code points.
std::size_t end_of(std::string_view text, std::size_t columns) {
    std::size_t end = 0;
    for (std::size_t taken = 0; end < text.size(); ++end)
        if (begins_code_point(text[end]) && taken++ == columns) break;
    return end;
}

std::size_t columns_of(std::string_view text) { return static_cast<std::size_t>(std::ranges::count_if(text, begins_code_point)); }

/// Returns one line wrapped at `width` columns, as wrapped() does.
std::string wrapped_line(std::string_view line, std::size_t width) {
    const std::size_t leading = std::min(line.find_first_not_of(' '), line.size());
    std::size_t column_begin = leading < 8 ? leading + 2 : leading;
    for (std::size_t at = line.find("  ", leading); at != std::string_view::npos; at = line.find("  ", at)) {
        at = std::min(line.find_first_not_of(' ', at), line.size());
        if (const std::size_t column = columns_of(line.substr(0, at)); column <= width * 2 / 3) column_begin = column;
    }
    const std::string indent(std::min(column_begin, width / 2), ' ');
    std::string text;
    while (columns_of(line) > width - (text.empty() ? 0 : indent.size())) {
        const std::size_t room = width - (text.empty() ? 0 : indent.size()), begin = line.find_first_not_of(' ');
        std::size_t space = line.rfind(' ', end_of(line, room));
        if (space == std::string_view::npos || space < begin) space = line.find(' ', begin);   // a word longer than the line
        if (space == std::string_view::npos) break;
        text += std::string(line.substr(0, line.find_last_not_of(' ', space) + 1)) + "\n" + indent;
        line.remove_prefix(std::min(line.find_first_not_of(' ', space), line.size()));
    }
    return text + std::string(line);
}

}   // namespace

std::string why_no_colors(int descriptor) {
    if (!variable("NO_COLOR").empty()) return "NO_COLOR is set";
    if (const std::string forced = variable("CLICOLOR_FORCE"); !forced.empty() && forced != "0") return "";
    if (::isatty(descriptor) != 1) return "the output is no terminal";
    if (const std::string kind = variable("TERM"); kind.empty() || kind == "dumb") return "TERM is '" + kind + "'";
    return variable("CLICOLOR") == "0" ? "CLICOLOR is 0" : "";
}

std::string inked(Ink ink, const std::string& text, int descriptor) {
    return has_colors(descriptor) ? "\x1b[" + std::to_string(static_cast<int>(ink)) + "m" + text + "\x1b[0m" : text;
}

std::string with_bold_numbers(const std::string& text, int descriptor) {
    static const std::regex number("[0-9]+([.][0-9]+)?");
    return has_colors(descriptor) ? std::regex_replace(text, number, "\x1b[1m$&\x1b[22m") : text;
}

TerminalSize terminal_size(int descriptor) {
    winsize size{};
    if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return {size.ws_col, size.ws_row > 0 ? size.ws_row : TerminalSize{}.rows, size.ws_xpixel, size.ws_ypixel};
    const auto length = [](const char* name, long long usual) {
        return static_cast<int>(std::clamp(parse_integer(variable(name)).value_or(usual), 1LL, 1000LL));
    };
    return {length("COLUMNS", 80), length("LINES", 24), 0, 0};
}

int terminal_width(int descriptor) { return terminal_size(descriptor).columns; }

std::string wrapped(const std::string& text, int width) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        result += wrapped_line(std::string_view(text).substr(begin, end - begin), static_cast<std::size_t>(std::max(1, width)));
        if (end < text.size()) result += '\n';
        begin = end + 1;
    }
    return result;
}

std::string for_terminal(const std::string& text, int descriptor) {
    return ::isatty(descriptor) == 1 ? wrapped(text, terminal_width(descriptor)) : text;
}

std::string shortened(const std::string& text, int columns) {
    const auto room = static_cast<std::size_t>(std::max(0, columns));
    if (columns_of(text) <= room) return text;
    if (room < 2) return text.substr(0, end_of(text, room));
    std::string start = text.substr(0, end_of(text, room - 1));
    if (const std::size_t space = start.rfind(' '); space != std::string::npos) start.resize(space + 1);
    return start + "…";
}

}   // namespace meshfolio
