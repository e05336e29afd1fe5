#include "report/page/math_markup.h"

#include <algorithm>
#include <array>

namespace meshfolio::report {

namespace {

template <std::size_t n>
bool is_in(std::string_view word, const std::array<std::string_view, n>& words) {
    return std::ranges::find(words, word) != words.end();
}

bool is_variable(std::string_view word) { return word.size() <= 3 && !is_function(word) && word != "or"; }
bool is_capital_greek(std::string_view c) { return c.size() == 2 && c >= "\u0391" && c <= "\u03a9"; }
bool is_word_character(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

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

/// The letters of a variable that ends at `end`; its last is a vector if it has the name of one, and p if what is around it says so.
void append_variable(std::vector<MathPart>& parts, const std::string& word, const std::string& math, std::size_t end) {
    const auto behind = [&](std::string_view mark) { return math.compare(end, mark.size(), mark) == 0; };
    const std::string_view before = std::string_view(math).substr(0, end - 1);
    const bool is_point = behind("_u") || behind("_v") || behind("(") || behind("·") || before.ends_with("·");
    const bool is_vector = word == "x" || word == "n" || (word.size() == 2 && word[0] < 'a' && (word[1] == 'x' || word[1] == 'n')) ||
                           (word == "p" && is_point);
    append(parts, MathPart::Kind::variable, word.substr(0, word.size() - is_vector));
    if (is_vector) append(parts, MathPart::Kind::vector, word.substr(word.size() - 1));
}

/// Where a symbol's index, exponents and primes end.
std::size_t scripts_end(const std::string& s, std::size_t end) {
    static constexpr std::array<std::string_view, 20> scripts{"₀", "₁", "₂", "ᵢ", "ⱼ", "⁰", "¹", "²", "³", "⁴",
                                                              "⁵", "⁶", "⁷", "⁸", "⁹", "⁻", "ᵀ", "ᵗ", "ᵖ", "'"};
    for (;;) {
        std::size_t next = end + math_character(s, end);
        if (s.compare(end, 1, "_") == 0) {
            while (next < s.size() && (is_letter(s[next]) || is_digit(s[next]))) ++next;
            if (next == end + 1) return end;
        } else if (!is_in(std::string_view(s).substr(end, next - end), scripts)) {
            return end;
        }
        if (s[end] == '\'' && next < s.size() && is_letter(s[next])) return end;   // a genitive
        end = next;
    }
}

/// Whether the word from `at` to `end` is a Latin symbol, or a product of some.
bool is_latin_symbol(std::string_view s, std::size_t at, std::size_t end) {
    static constexpr std::array<std::string_view, 6> products{"Lx", "MX", "LX", "CX", "du", "dv"};
    const std::string_view word = s.substr(at, end - at), before = s.substr(0, at), behind = s.substr(end);
    if (word.size() > 1) return is_in(word, products);
    if (scripts_end(std::string(behind), 0) > 0) return true;
    const auto after = [&](auto... marks) { return (before.ends_with(marks) || ...); };
    const auto follows = [&](auto... marks) { return (behind.starts_with(marks) || ...); };
    const auto goes_on = [&](std::size_t i) { return i < behind.size() && is_word_character(behind[i]); };
    const bool relates = follows(" =", " <", " >"), starts = before.empty() || after(". ");
    const bool is_label = follows(":") || (starts && !relates && (word[0] >= 'a' || follows(".")));
    const bool is_unit = at > 1 && s[at - 1] == ' ' && is_digit(s[at - 2]);
    const bool in_name = goes_on(0) || (follows(".") && goes_on(1)) || follows("+", "’") || after(".", "-", "’", "'");
    if (is_label || is_unit || in_name) return false;
    if (word == "a") return relates || !(behind.empty() || follows(" "));
    if (word == "A") return after("/", "√", "Σ ", "area ");
    if (word == "x") return after("‖", "·") || follows("·", "‖");
    if (word == "n") return !after("= ", "over ");
    return std::string_view("BIyz").find(word) == std::string_view::npos;
}

/// Where the symbol that begins at `at` ends; `at` if none does.
std::size_t symbol_end(const std::string& s, std::size_t at) {
    std::size_t end = at;
    for (std::size_t next; (next = end + math_character(s, end)) > end; end = next) {
        const std::string_view c = std::string_view(s).substr(end, next - end), letter = c.substr(0, 2);
        if (!is_small_greek(letter) && !(is_capital_greek(letter) && letter != "Σ") && c != "ĉ" && !(is_letter(c[0]) && c.size() > 1))
            break;
    }
    const std::size_t greek = end;
    while (end < s.size() && is_letter(s[end]) && math_character(s, end) == 1) ++end;
    if (greek > at) return scripts_end(s, end - greek <= 2 ? end : greek);
    if (end == at || (at > 0 && is_word_character(s[at - 1]))) return at;
    return is_latin_symbol(s, at, end) ? scripts_end(s, end) : at;
}

/// Blanks around relations and before units no longer break lines.
std::string kept_together(const std::string& words) {
    static constexpr std::array<std::string_view, 12> signs{"=", "<", ">", "≤", "≥", "≈", "±", "×", "·", "−", "+", "∝"};
    static constexpr std::array<std::string_view, 11> units{"s", "ms", "min", "h", "mm", "px", "MB", "KB", "GB", "kB", "%"};
    std::string kept;
    for (std::size_t at = 0; at < words.size(); ++at) {
        if (words[at] != ' ') {
            kept += words[at];
            continue;
        }
        const std::size_t next = at + 1, sign = next + math_character(words, next);
        std::size_t word = next;
        while (word < words.size() && (is_letter(words[word]) || words[word] == '%')) ++word;
        const bool is_sign = words.compare(sign, 1, " ") == 0 && is_in(std::string_view(words).substr(next, sign - next), signs);
        const bool is_unit = at > 0 && is_digit(words[at - 1]) && is_in(std::string_view(words).substr(next, word - next), units);
        kept += is_sign || is_unit ? "\u00a0" : " ";
        if (is_sign) {
            kept += words.substr(next, sign - next) + "\u00a0";
            at = sign;
        }
    }
    return kept;
}

/// Operators, digits and names as TeX.
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
    return is_in(word, names);
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
            if (is_variable(word))
                append_variable(parts, word, math, end);
            else
                append(parts, Kind::upright, word);
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
    std::string tex;
    for (const MathPart& part : math_parts(math)) {
        switch (part.kind) {
            case MathPart::Kind::upright:
                tex += upright_tex(part.text);
                break;
            case MathPart::Kind::variable:
                tex += part.text;
                break;
            case MathPart::Kind::vector:
                tex += depth > 0 ? part.text : "\\mathbf{" + part.text + "}";
                break;
            default:
                tex += part.kind == MathPart::Kind::subscript ? "_{" : "^{";
                tex += (depth < 3 ? tex_of(part.text, depth + 1) : upright_tex(part.text)) + "}";
        }
    }
    return tex;
}

Text prose(const std::string& words) {
    Text runs;
    std::string plain;
    const auto flush = [&] {
        if (!plain.empty()) runs.push_back({Run::Kind::plain, kept_together(plain)});
        plain.clear();
    };
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = symbol_end(words, at);
        if (end > at) {
            flush();
            runs.push_back(math(words.substr(at, end - at)));
            at = end;
        } else {
            const std::size_t length = math_character(words, at);
            plain += words.substr(at, length);
            at += length;
        }
    }
    flush();
    return runs;
}

}   // namespace meshfolio::report
