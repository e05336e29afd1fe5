/// @file
/// Splits mathematics in a sentence, "λ_crit = 2/μ_max", into letters, indices and exponents, and finds it in prose.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/text.h"

namespace meshfolio::report {

inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// α to ω: U+03B1 to U+03C9.
inline bool is_small_greek(std::string_view c) { return c.size() == 2 && c >= "\u03b1" && c <= "\u03c9"; }
/// sin, max and others, which are upright and have an argument.
bool is_function(std::string_view word);
using Pairs = std::map<std::string, std::string>;
/// "a b c d": a to b and c to d.
Pairs pairs_in(const char* list);
/// "²" as "^2", "ⱼ" as "_j"; empty for what is no such character.
const std::string& unicode_script(const std::string& c);
/// Bytes of the character at `at` with its accents (U+0300 to U+036F); 0 at the end.
std::size_t math_character(std::string_view text, std::size_t at);

struct MathPart {
    enum class Kind { upright, variable, vector, subscript, superscript };
    Kind kind = Kind::upright;
    std::string text;
};

/// Single Latin letters, pairs such as "du" and small Greek letters are variables; names of functions and longer words are upright.
/// Vectors are x and n, also in "Lx" and "2Hn", and p where it has the index u or v, an argument, or stands in a product of vectors.
/// `_` and `^` take the word, the number or the {group} that follows.
std::vector<MathPart> math_parts(const std::string& math);

/// The same as TeX: "\\mathbf{x}_{i}". @param depth  of scripts around it, where letters are no vectors
std::string tex_of(const std::string& math, int depth = 0);

/// Finds mathematics in prose, "½‖Δx‖ times 4/h²", and keeps together what no line may break: "K × edge", "9.8 s". A formula is what stands
/// around a symbol without a blank, and what relations and signs join to it: "a = 1.70", "1 − λμ". Symbols are Greek letters, letters with
/// an accent, single Latin letters and a few products, each with its index and exponents. No symbols are the words "a" and "I", the axes
/// x, y and z, units ("9.8 s"), labels ("b: …") and parts of names ("b.obj", "S1"); x is one where it is a vector, and n where it is no
/// count.
Text prose(const std::string& words);

}   // namespace meshfolio::report
