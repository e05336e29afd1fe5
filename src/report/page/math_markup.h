/// @file
/// Finds mathematics in prose, and splits it, "λ_crit = 2/μ_max", into letters, indices and exponents.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/lower_case.h"
#include "report/text.h"

namespace meshfolio::report {

/// True for α to ω: U+03B1 to U+03C9.
inline bool is_small_greek(std::string_view c) { return c.size() == 2 && c >= "\u03b1" && c <= "\u03c9"; }
/// True for the names of 15 functions: sin, cos, tan, cot, arctan, log, ln, exp, min, max, sup, inf, rms, det, tr.
bool is_function(std::string_view word);
using Pairs = std::map<std::string, std::string>;
/// Returns the map of a to b and c to d for "a b c d".
Pairs pairs_in(const char* list);
/// Returns "^2" for "²" and "_j" for "ⱼ"; empty for characters that are no script.
const std::string& unicode_script(const std::string& c);
/// Returns the number of bytes of the character at `at` with the accents behind it (U+0300 to U+036F); 0 at the end.
std::size_t math_character(std::string_view text, std::size_t at);

struct MathPart {
    enum class Kind { upright, variable, vector, subscript, superscript };
    Kind kind = Kind::upright;
    std::string text;
};

/// Splits mathematics into its parts. Single Latin letters, pairs such as "du" and small Greek letters are variables; names of functions
/// and longer words are upright. Vectors are x and n, also in "Lx" and "2Hn", and p with the index u or v, an argument, or in a product.
/// `_` and `^` take the next word, number or {group}.
std::vector<MathPart> math_parts(const std::string& math);

/// Returns mathematics as TeX: "\\mathbf{x}_{i}". @param depth  of scripts around it; letters of scripts are no vectors
std::string tex_of(const std::string& math, int depth = 0);

/// Returns prose with its mathematics as runs, "½‖Δx‖ times 4/h²", and with no-break spaces in "K × edge" and "9.8 s". A formula is a
/// symbol with all characters around it up to the next spaces, and with the operands that relations and signs join to it: "a = 1.70", "1 −
/// λμ". Symbols are Greek letters, letters with an accent, single Latin letters and a few products, each with its index and exponents. No
/// symbols are the words "a" and "I", the axes x, y and z, units ("9.8 s"), labels ("b: …"), parts of names ("b.obj", "S1") and n as a
/// count.
Text prose(const std::string& words);

}   // namespace meshfolio::report
