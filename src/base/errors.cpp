#include "base/errors.h"

#include <cstdint>

namespace meshfolio {

namespace {

std::string one_line(const Location& where, const std::string& problem, const std::string& remedy) {
    std::string line;
    if (!where.file.empty()) line += where.file + (where.line > 0 ? ":" + std::to_string(where.line) : "") + ": ";
    line += problem;
    if (!remedy.empty()) line += "; " + remedy;
    return printable(line);
}

struct CodePoint {
    std::uint32_t value;
    int length;   // bytes; 0: not UTF-8
};

/// Decodes the code point that begins at byte `at`; refuses overlong forms and surrogates (RFC 3629).
CodePoint decode_utf8(const std::string& text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned lead = byte(at);
    if (lead < 0x80) return {lead, 1};
    const int length = lead >= 0xf0 && lead < 0xf8 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc2 ? 2 : 0;
    if (length == 0 || lead >= 0xf8) return {0, 0};
    std::uint32_t value = lead & (0xffu >> (length + 1));
    for (int i = 1; i < length; ++i) {
        const unsigned next = byte(at + static_cast<std::size_t>(i));
        if ((next & 0xc0u) != 0x80u) return {0, 0};
        value = value << 6 | (next & 0x3fu);
    }
    constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = value >= 0xd800 && value < 0xe000;
    if (value < smallest[length] || value > 0x10ffff || surrogate) return {0, 0};
    return {value, length};
}

/// True for control characters, line separators and bidirectional marks.
bool is_unsafe(std::uint32_t code) {
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
        const CodePoint c = decode_utf8(text, i);
        const auto length = static_cast<std::size_t>(c.length > 0 ? c.length : 1);
        const bool is_safe = c.length > 0 && !is_unsafe(c.value);
        for (const std::size_t end = i + length; i < end; ++i) {
            const auto byte = static_cast<unsigned char>(text[i]);
            shown += is_safe ? std::string(1, text[i]) : std::string{'\\', 'x', hex[byte >> 4], hex[byte & 15]};
        }
    }
    return shown;
}

}   // namespace meshfolio
