#include "report/escape.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/errors.h"

namespace meshfolio::report {

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

/// At the beginning of a block these characters would make a heading, a list, a rule or an underlined title of it.
bool begins_block(const std::string& text, std::size_t i) {
    const char c = text[i];
    if (i == 0 && (c == '#' || c == '-' || c == '+' || c == '=')) {
        const std::size_t end = text.find_first_not_of(c);
        return end == std::string::npos || text[end] == ' ';
    }
    const bool after_number = i > 0 && text.find_first_not_of("0123456789") == i;
    const bool before_space = i + 1 == text.size() || text[i + 1] == ' ';
    return after_number && before_space && (c == '.' || c == ')');
}

bool is_within_word(const std::string& text, std::size_t i) {
    return i > 0 && i + 1 < text.size() && is_alphanumeric(text[i - 1]) && is_alphanumeric(text[i + 1]);
}

/// GitHub makes links of https://…, www.… and name@host where they stand alone in a text.
bool makes_link(const std::string& text, std::size_t i) {
    if (text[i] == ':') return text.compare(i, 3, "://") == 0;
    if (text[i] == '.') return i >= 3 && (text.compare(i - 3, 3, "www") == 0 || text.compare(i - 3, 3, "WWW") == 0);
    return text[i] == '@';
}

}   // namespace

std::string safe_text(const std::string& text) {
    std::string line = text;
    for (char& c : line)
        if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    line = printable(line);
    replace_all(line, "\xEF\xBF\xBE", "\uFFFD");   // U+FFFE and U+FFFF are UTF-8, but no characters of XML
    replace_all(line, "\xEF\xBF\xBF", "\uFFFD");
    return line;
}

std::string valid_utf8(const std::string& text) {
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

std::string xml_escape(const std::string& text) {
    constexpr std::string_view special = "&<>\"'", names[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    std::string escaped;
    escaped.reserve(text.size() + text.size() / 8);
    for (const char c : text) {
        const std::size_t i = special.find(c);
        if (i == special.npos)
            escaped += c;
        else
            escaped += names[i];
    }
    return escaped;
}

std::string markdown_escape(const std::string& text) {
    constexpr std::string_view special = "\\`*[]|~$";
    std::string escaped;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '&' || c == '<' || c == '>') {
            escaped += xml_escape({c});
        } else {
            const bool emphasis = c == '_' && !is_within_word(text, i);
            if (emphasis || special.find(c) != std::string_view::npos || begins_block(text, i) || makes_link(text, i)) escaped += '\\';
            escaped += c;
        }
    }
    return escaped;
}

std::string url_path(const std::string& path) {
    constexpr std::string_view safe = "._~/-", hex = "0123456789ABCDEF";
    std::string url;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (is_alphanumeric(c) || safe.find(c) != std::string_view::npos) {
            url += c;
        } else {
            url += {'%', hex[byte >> 4], hex[byte & 15]};
        }
    }
    return url;
}

}   // namespace meshfolio::report
