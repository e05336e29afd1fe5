// Finds mathematics in texts that do not mark it: captions, heads, names of checks, words between marked formulas.
#include <algorithm>
#include <array>

#include "report/page/math_markup.h"

namespace meshfolio::report {

namespace {

template <std::size_t n> bool is_in(std::string_view word, const std::array<std::string_view, n>& words) {
    return std::ranges::find(words, word) != words.end();
}

bool is_word_character(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

/// True if the character at `at` can be part of a name: letters, digits, "_", and À to ɏ except × and ÷.
bool is_of_name(std::string_view s, std::size_t at) {
    if (at >= s.size()) return false;
    const std::string_view c = s.substr(at, 2);
    return is_word_character(s[at]) || (c[0] >= '\xc3' && c[0] <= '\xc9' && c != "×" && c != "÷");
}

/// Returns the end of a symbol's index, exponents and primes, which begin at `end`.
std::size_t scripts_end(const std::string& s, std::size_t end) {
    for (;;) {
        std::size_t next = end + math_character(s, end);
        if (s.compare(end, 1, "_") == 0) {
            while (next < s.size() && (is_letter(s[next]) || is_digit(s[next]))) ++next;
            const std::string_view index = std::string_view(s).substr(end + 1, next - end - 1);
            const bool is_of_letter = end > 0 && is_letter(s[end - 1]) && index.size() > 2 && index != "max" && index != "min";   // "t_rex"
            if (index.empty() || is_of_letter || is_of_name(s, next)) return end;
        } else if (s.compare(end, 1, "'") != 0 && unicode_script(s.substr(end, next - end)).empty()) {
            return end;
        }
        if (s[end] == '\'' && next < s.size() && is_letter(s[next])) return end;   // a genitive
        end = next;
    }
}

/// True if the word from `at` to `end` is a Latin symbol or a product of symbols.
bool is_latin_symbol(std::string_view s, std::size_t at, std::size_t end) {
    static constexpr std::array<std::string_view, 6> products{"Lx", "MX", "LX", "CX", "du", "dv"};
    const std::string_view word = s.substr(at, end - at), before = s.substr(0, at), behind = s.substr(end);
    if (word.size() > 1) return is_in(word, products);
    if (scripts_end(std::string(s), end) > end) return true;
    const auto after = [&](auto... marks) { return (before.ends_with(marks) || ...); };
    const auto follows = [&](auto... marks) { return (behind.starts_with(marks) || ...); };
    const auto goes_on = [&](std::size_t i) { return is_of_name(behind, i); };
    const bool alone = before.empty() && behind.empty();   // the head of a column
    const bool relates = follows(" =", " <", " >") || alone, starts = before.empty() || after(". ");
    const bool is_label = (follows(":") && (starts || after("and "))) || (starts && !relates && (word[0] >= 'a' || follows(".")));
    const bool is_unit = at > 1 && s[at - 1] == ' ' && is_digit(s[at - 2]);
    const bool in_name = goes_on(0) || (follows(".") && goes_on(1)) || follows("+", "’") || after(".", "-", "’", "'");
    if (is_label || is_unit || in_name) return false;
    if (word == "a") return relates || !(behind.empty() || follows(" "));
    if (word == "A") return after("/", "√", "Σ ", "area ");
    if (word == "x") return after("‖", "·") || follows("·", "‖");
    if (word == "n") return !after("= ", "over ");
    return std::string_view("BIyz").find(word) == std::string_view::npos;
}

/// Returns the end of the symbol at `at`; `at` if there is none.
std::size_t symbol_end(const std::string& s, std::size_t at) {
    std::size_t end = at;
    for (std::size_t next; (next = end + math_character(s, end)) > end; end = next) {
        const std::string_view c = std::string_view(s).substr(end, next - end), letter = c.substr(0, 2);
        const bool is_capital_greek = letter.size() == 2 && letter >= "\u0391" && letter <= "\u03a9";
        if (!is_small_greek(letter) && !(is_capital_greek && letter != "Σ") && c != "ĉ" && !(is_letter(c[0]) && c.size() > 1)) break;
    }
    const std::size_t greek = end;
    while (end < s.size() && is_letter(s[end]) && math_character(s, end) == 1) ++end;
    if (greek > at) return scripts_end(s, end - greek <= 2 ? end : greek);
    const bool after_name = at > 0 && (is_word_character(s[at - 1]) || (at > 1 && is_of_name(s, at - 2) && !is_word_character(s[at - 2])));
    if (end == at || after_name) return at;
    if (is_function(std::string_view(s).substr(at, end - at)) && s.compare(end, 1, " ") == 0) {
        const std::size_t argument = symbol_end(s, end + 1);
        if (argument > end + 1) return argument;
    }
    return is_latin_symbol(s, at, end) ? scripts_end(s, end) : at;
}

constexpr std::array<std::string_view, 11> signs{"=", "<", ">", "≤", "≥", "≈", "±", "×", "·", "−", "+"};

/// Returns the end of the symbols, numbers, fences and operators that follow each other from `at` on without a space.
std::size_t formula_end(const std::string& s, std::size_t at) {
    static constexpr std::string_view marks = "/^()[]|‖√½Σ∑∞∇∫°";
    for (std::size_t end; at < s.size(); at = end) {
        end = symbol_end(s, at);
        if (end > at) continue;
        while (end < s.size() && is_letter(s[end])) ++end;
        if (end > at && is_function(std::string_view(s).substr(at, end - at))) {
            end += s.compare(end, 1, " ") == 0 && symbol_end(s, end + 1) > end + 1;
            continue;
        }
        end = at + math_character(s, at);
        const std::string_view c = std::string_view(s).substr(at, end - at);
        const bool in_number = at > 0 && is_digit(s[at - 1]) && end < s.size() && (is_digit(s[end]) || s[end] == '%');
        const bool is_percent = c == "%" && at > 2 && s.compare(at - 3, 3, "\u202f") == 0;
        if (is_digit(c[0]) || is_in(c, signs) || marks.find(c) != std::string_view::npos || scripts_end(s, at) > at) continue;
        if (!is_percent && !(in_number && (c == "." || c == "\u202f"))) return at;
    }
    return at;
}

/// True if every fence has its partner.
bool is_balanced(std::string_view formula) {
    long depth = 0, bars = 0, norms = 0;
    for (std::size_t at = 0, length; depth >= 0 && (length = math_character(formula, at)) > 0; at += length) {
        const std::string_view c = formula.substr(at, length);
        depth += (c == "(" || c == "[") - (c == ")" || c == "]");
        bars += c == "|";
        norms += c == "‖";
    }
    return depth == 0 && bars % 2 == 0 && norms % 2 == 0;
}

/// Returns the formula around the symbol from `begin` to `end`, not before `from`: "½‖Δx‖", "K = 0"; the symbol alone if fences do not
/// match.
std::string_view formula_around(const std::string& s, std::size_t from, std::size_t begin, std::size_t end) {
    const std::string_view all = s, symbol = all.substr(begin, end - begin);
    std::size_t first = std::max(from, s.find_last_of(' ', begin) + 1);
    while (first < begin && formula_end(s, first) < begin) first += math_character(s, first);
    while (first > from + 2 && s[first - 1] == ' ') {
        const std::size_t blank = s.find_last_of(' ', first - 2);
        if (blank == std::string::npos || blank <= from || !is_in(all.substr(blank + 1, first - blank - 2), signs)) break;
        const std::size_t before = std::max(from, s.find_last_of(' ', blank - 1) + 1);
        if (before == blank || formula_end(s, before) != blank) break;
        first = before;
    }
    std::size_t last = formula_end(s, begin);
    for (;;) {
        const std::size_t sign = last + 1, blank = sign + math_character(s, sign);
        if (all.substr(last, 1) != " " || all.substr(blank, 1) != " " || !is_in(all.substr(sign, blank - sign), signs)) break;
        const std::size_t next = formula_end(s, blank + 1);
        if (next == blank + 1 || !is_balanced(all.substr(blank + 1, next - blank - 1)) || (next < s.size() && is_word_character(s[next])))
            break;
        last = next;
    }
    for (std::size_t until = last; until >= end && until - first < 200; --until) {   // the longest whose fences match
        if (until < s.size() && ((s[until] & '\xc0') == '\x80' || s[until] == '\xcc')) continue;
        if (until > end && std::string_view("/ =<>").find(s[until - 1]) != std::string_view::npos) continue;
        for (std::size_t start = first; start <= begin; start += math_character(s, start))
            if (s[start] != '/' && s[start] != ' ' && is_balanced(all.substr(start, until - start)))
                return all.substr(start, until - start);
    }
    return symbol;
}

/// Returns words with no-break spaces around relations and before units.
std::string kept_together(std::string words) {
    static constexpr std::array<std::string_view, 11> units{"s", "ms", "min", "h", "mm", "px", "MB", "KB", "GB", "kB", "%"};
    for (std::size_t at = 0; (at = words.find(' ', at)) != std::string::npos; ++at) {
        const std::size_t next = at + 1, sign = next + math_character(words, next);
        std::size_t unit = next;
        while (unit < words.size() && (is_letter(words[unit]) || words[unit] == '%')) ++unit;
        const bool is_sign = words.compare(sign, 1, " ") == 0 && is_in(std::string_view(words).substr(next, sign - next), signs);
        const bool is_unit = at > 0 && is_digit(words[at - 1]) && is_in(std::string_view(words).substr(next, unit - next), units);
        if (is_sign) words.replace(sign, 1, "\u00a0");
        if (is_sign || is_unit) words.replace(at, 1, "\u00a0");
    }
    return words;
}

}   // namespace

Text prose(const std::string& words) {
    Text runs;
    std::size_t from = 0;
    const auto add_plain = [&](std::size_t end) {
        if (end > from) runs.push_back({Run::Kind::plain, kept_together(words.substr(from, end - from))});
    };
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = symbol_end(words, at);
        if (end == at) {
            at += math_character(words, at);
            continue;
        }
        const std::string_view formula = formula_around(words, from, at, end);
        const auto begin = static_cast<std::size_t>(formula.data() - words.data());
        add_plain(begin);
        runs.push_back(math(std::string(formula)));
        from = begin + formula.size();
        at = from;
    }
    add_plain(words.size());
    return runs;
}

}   // namespace meshfolio::report
