#include "base/errors.h"

#include <algorithm>

#include "base/utf8.h"

namespace meshfolio {

namespace {

std::string one_line(const Location& where, const std::string& problem, const std::string& remedy) {
    std::string line;
    if (!where.file.empty()) line += where.file + (where.line > 0 ? ":" + std::to_string(where.line) : "") + ": ";
    line += problem;
    if (!remedy.empty()) line += "; " + remedy;
    return printable(line);
}

/// True for control characters, line separators and bidirectional marks.
bool is_unsafe(char32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

}   // namespace

Error::Error(ExitCode code, const Location& where, const std::string& problem, const std::string& remedy)
    : std::runtime_error(one_line(where, problem, remedy)), exit_code_(code) {}

std::string printable(const std::string& text) {
    constexpr char hex[] = "0123456789abcdef";
    std::string shown;
    for (std::size_t i = 0; i < text.size();) {
        const CodePoint c = code_point_at(text, i);
        const std::size_t length = std::max<std::size_t>(c.length, 1);
        const bool is_safe = c.length > 0 && !is_unsafe(c.value);
        for (const std::size_t end = i + length; i < end; ++i) {
            const auto byte = static_cast<unsigned char>(text[i]);
            shown += is_safe ? std::string(1, text[i]) : std::string{'\\', 'x', hex[byte >> 4], hex[byte & 15]};
        }
    }
    return shown;
}

}   // namespace meshfolio
