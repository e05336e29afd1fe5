/// @file
/// Mathematics within a sentence: "λ_crit = 2/μ_max" into letters, indices and exponents.
#pragma once

#include <string>
#include <vector>

namespace meshfolio::report {

struct MathPart {
    enum class Kind { upright, variable, subscript, superscript };
    Kind kind = Kind::upright;
    std::string text;
};

/// Single Latin letters, pairs such as "du" and small Greek letters are variables; names of functions and longer words are upright.
/// `_` and `^` take the word, the number or the {group} that follows.
std::vector<MathPart> math_parts(const std::string& math);

}   // namespace meshfolio::report
