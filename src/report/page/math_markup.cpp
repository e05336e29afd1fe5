#include "report/page/math_markup.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace meshfolio::report {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t character_length(const std::string& s, std::size_t at) {
    std::size_t end = at + 1;
    while (end < s.size() && (s[end] & '\xc0') == '\x80') ++end;
    return end - at;
}

/// α to ω: U+03B1 to U+03C9.
bool is_small_greek(std::string_view c) { return c.size() == 2 && c >= "\u03b1" && c <= "\u03c9"; }

bool is_variable(std::string_view word) {
    constexpr std::array<std::string_view, 14> upright{"sin", "cos", "tan", "cot", "log", "exp", "min",
                                                       "max", "rms", "det", "sup", "inf", "ln",  "or"};
    return word.size() <= 3 && std::find(upright.begin(), upright.end(), word) == upright.end();
}

/// What an index or exponent at `at` holds: a {group}, or a sign with the word or number behind it, or one character.
std::string script_at(const std::string& s, std::size_t& at) {
    if (at < s.size() && s[at] == '{') {
        const std::size_t end = std::min(s.find('}', at), s.size());
        std::string inside = s.substr(at + 1, end - at - 1);
        at = std::min(end + 1, s.size());
        return inside;
    }
    std::size_t end = at;
    for (const std::string_view sign : {"-", "\u2212"})
        if (s.compare(end, sign.size(), sign) == 0) end += sign.size();
    const std::size_t word = end;
    while (end < s.size() && (is_letter(s[end]) || is_digit(s[end]))) ++end;
    if (end == word && end < s.size()) end += character_length(s, end);
    std::string script = s.substr(at, end - at);
    at = end;
    return script;
}

bool is_greek(std::string_view c) { return is_small_greek(c) || (c.size() == 2 && c >= "\u0391" && c <= "\u03a9"); }

/// Where the symbol that begins at `at` ends; `at` if none does.
std::size_t symbol_end(const std::string& s, std::size_t at) {
    const std::size_t letter = character_length(s, at);
    if (!is_greek(std::string_view(s).substr(at, letter)) || at + letter >= s.size() || s[at + letter] != '_') return at;
    std::size_t end = at + letter + 1;
    while (end < s.size() && (is_letter(s[end]) || is_digit(s[end]))) ++end;
    return end == at + letter + 1 ? at : end;
}

void append(std::vector<MathPart>& parts, MathPart::Kind kind, const std::string& text) {
    const bool joins = kind == MathPart::Kind::upright && !parts.empty() && parts.back().kind == kind;
    if (joins) {
        parts.back().text += text;
    } else {
        parts.push_back({kind, text});
    }
}

}   // namespace

std::vector<MathPart> math_parts(const std::string& math) {
    using Kind = MathPart::Kind;
    std::vector<MathPart> parts;
    for (std::size_t at = 0; at < math.size();) {
        const bool script = (math[at] == '_' || math[at] == '^') && at > 0 && at + 1 < math.size() && math[at + 1] != ' ';
        if (script) {
            const Kind kind = math[at] == '_' ? Kind::subscript : Kind::superscript;
            append(parts, kind, script_at(math, ++at));
        } else if (is_letter(math[at])) {
            std::size_t end = at;
            while (end < math.size() && is_letter(math[end])) ++end;
            const std::string word = math.substr(at, end - at);
            append(parts, is_variable(word) ? Kind::variable : Kind::upright, word);
            at = end;
        } else {
            const std::string c = math.substr(at, character_length(math, at));
            append(parts, is_small_greek(c) ? Kind::variable : Kind::upright, c);
            at += c.size();
        }
    }
    return parts;
}

Text prose(const std::string& words) {
    Text runs;
    std::string plain;
    const auto flush = [&] {
        if (!plain.empty()) runs.push_back({Run::Kind::plain, plain});
        plain.clear();
    };
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = symbol_end(words, at);
        if (end > at) {
            flush();
            runs.push_back(math(words.substr(at, end - at)));
            at = end;
        } else {
            const std::size_t length = character_length(words, at);
            plain += words.substr(at, length);
            at += length;
        }
    }
    flush();
    return runs;
}

}   // namespace meshfolio::report
