#include "report/page/math_markup.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace meshfolio::report {

namespace {

/// Returns the index or exponent at `at` and moves `at` behind it: a {group}, a word or number with its sign, or one character.
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
    if (end == word && end < s.size()) end += math_character(s, end);
    std::string script = s.substr(at, end - at);
    at = end;
    return script;
}

void append(std::vector<MathPart>& parts, MathPart::Kind kind, const std::string& text) {
    const bool joins = kind == MathPart::Kind::upright && !parts.empty() && parts.back().kind == kind;
    if (joins) {
        parts.back().text += text;
    } else if (!text.empty()) {
        parts.push_back({kind, text});
    }
}

/// Appends the variable `word`, which ends at `end`. Its last letter is a vector if it is x or n, or p beside certain neighbours.
void append_variable(std::vector<MathPart>& parts, const std::string& word, const std::string& math, std::size_t end) {
    const auto behind = [&](std::string_view mark) { return math.compare(end, mark.size(), mark) == 0; };
    const std::string_view before = std::string_view(math).substr(0, end - 1);
    const bool is_point = behind("_u") || behind("_v") || behind("(") || behind("·") || before.ends_with("·");
    const bool is_vector = word == "x" || word == "n" || (word.size() == 2 && word[0] < 'a' && (word[1] == 'x' || word[1] == 'n')) ||
                           (word == "p" && is_point);
    append(parts, MathPart::Kind::variable, word.substr(0, word.size() - is_vector));
    if (is_vector) append(parts, MathPart::Kind::vector, word.substr(word.size() - 1));
}

/// Returns operators, digits and names as TeX.
std::string upright_tex(const std::string& text) {
    std::string tex;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end) {
        end = at;
        while (end < text.size() && is_letter(text[end])) ++end;
        if (end > at) {
            const std::string word = text.substr(at, end - at);
            const bool apart = at > 0 && text[at - 1] == ' ', goes_on = end < text.size() && text[end] == ' ';
            tex += is_function(word) ? "\\" + word + " " : "\\text{" + (apart ? " " + word : word) + (goes_on ? " }" : "}");
            continue;
        }
        end += math_character(text, at);
        const std::string c = text.substr(at, end - at);
        tex += c == " " ? "~" : c == "\\" ? "\\backslash " : std::string_view("{}_^&#~").find(c) != std::string_view::npos ? "\\" + c : c;
    }
    return tex;
}

}   // namespace

bool is_function(std::string_view word) {
    static constexpr std::array<std::string_view, 15> names{"sin", "cos", "tan", "cot", "arctan", "log", "ln", "exp",
                                                            "min", "max", "sup", "inf", "rms",    "det", "tr"};
    return std::ranges::find(names, word) != names.end();
}

Pairs pairs_in(const char* list) {
    std::istringstream in(list);
    Pairs pairs;
    for (std::string from, to; in >> from >> to;) pairs[from] = to;
    return pairs;
}

const std::string& unicode_script(const std::string& c) {
    static const std::string none;
    static const Pairs scripts = pairs_in("⁰ ^0 ¹ ^1 ² ^2 ³ ^3 ⁴ ^4 ⁵ ^5 ⁶ ^6 ⁷ ^7 ⁸ ^8 ⁹ ^9 ⁻ ^− ᵗ ^t ᵖ ^p ᵀ ^⊤ ₀ _0 ₁ _1 ₂ _2 ᵢ _i ⱼ _j");
    const auto script = scripts.find(c);
    return script == scripts.end() ? none : script->second;
}

std::size_t math_character(std::string_view text, std::size_t at) {
    if (at >= text.size()) return 0;
    std::size_t end = at + 1;
    while (end < text.size() && ((text[end] & '\xc0') == '\x80' || text[end] == '\xcc' ||
                                 (text[end] == '\xcd' && end + 1 < text.size() && text[end + 1] < '\xb0')))
        ++end;
    return end - at;
}

std::vector<MathPart> math_parts(const std::string& math) {
    using Kind = MathPart::Kind;
    std::vector<MathPart> parts;
    for (std::size_t at = 0; at < math.size();) {
        const bool script = (math[at] == '_' || math[at] == '^') && at > 0 && at + 1 < math.size() && math[at + 1] != ' ';
        if (script) {
            const Kind kind = math[at] == '_' ? Kind::subscript : Kind::superscript;
            append(parts, kind, script_at(math, ++at));
            continue;
        }
        std::size_t end = at;
        while (end < math.size() && is_letter(math[end]) && math_character(math, end) == 1) ++end;
        if (end > at) {
            const std::string word = math.substr(at, end - at);
            if (word.size() <= 3 && !is_function(word) && word != "or") append_variable(parts, word, math, end);
            else append(parts, Kind::upright, word);
        } else {
            end += math_character(math, at);
            const std::string c = math.substr(at, end - at);
            append(parts, is_small_greek(c.substr(0, 2)) || is_letter(c[0]) || c == "ĉ" ? Kind::variable : Kind::upright, c);
        }
        at = end;
    }
    return parts;
}

std::string tex_of(const std::string& math, int depth) {
    using Kind = MathPart::Kind;
    std::string tex;
    for (const MathPart& part : math_parts(math)) {
        if (part.kind == Kind::upright) {
            tex += upright_tex(part.text);
        } else if (part.kind == Kind::variable || part.kind == Kind::vector) {
            tex += part.kind == Kind::vector && depth == 0 ? "\\mathbf{" + part.text + "}" : part.text;
        } else {
            tex += part.kind == Kind::subscript ? "_{" : "^{";
            tex += (depth < 3 ? tex_of(part.text, depth + 1) : upright_tex(part.text)) + "}";
        }
    }
    return tex;
}

}   // namespace meshfolio::report
