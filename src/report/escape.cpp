#include "report/escape.h"

#include "base/errors.h"
#include "base/lower_case.h"

namespace meshfolio::report {

namespace {

/// True for a character that would turn the line into a heading, a list, a rule or an underlined title.
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

}   // namespace

std::string safe_text(const std::string& text) {
    std::string line = text;
    for (char& c : line)
        if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    line = printable(line);
    for (const std::string_view code : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})   // U+FFFE and U+FFFF are no characters of XML
        for (std::size_t at = line.find(code); at != std::string::npos; at = line.find(code, at)) line.replace(at, code.size(), "\uFFFD");
    return line;
}

std::string xml_escape(const std::string& text) {
    constexpr std::string_view special = "&<>\"'", names[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    std::string escaped;
    escaped.reserve(text.size() + text.size() / 8);
    for (const char c : text) {
        const std::size_t i = special.find(c);
        if (i == special.npos) escaped += c;
        else escaped += names[i];
    }
    return escaped;
}

std::string markdown_escape(const std::string& text) {
    constexpr std::string_view special = "\\`*[]|~$";
    const std::string_view all = text;
    std::string escaped;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '&' || c == '<' || c == '>') {
            escaped += xml_escape({c});
            continue;
        }
        const bool within_word = i > 0 && i + 1 < text.size() && is_alphanumeric(text[i - 1]) && is_alphanumeric(text[i + 1]);
        const bool emphasis = c == '_' && !within_word;
        const std::string_view before = all.substr(0, i);   // GitHub makes links of https://…, www.… and name@host
        const bool link = c == '@' || all.substr(i, 3) == "://" || (c == '.' && (before.ends_with("www") || before.ends_with("WWW")));
        if (emphasis || link || special.find(c) != std::string_view::npos || begins_block(text, i)) escaped += '\\';
        escaped += c;
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
