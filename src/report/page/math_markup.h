/// @file
/// Splits mathematics in a sentence, "λ_crit = 2/μ_max", into letters, indices and exponents.
#pragma once

#include <string>
#include <vector>

#include "report/text.h"

namespace meshfolio::report {

struct MathPart {
    enum class Kind { upright, variable, subscript, superscript };
    Kind kind = Kind::upright;
    std::string text;
};

/// Single Latin letters, pairs such as "du" and small Greek letters are variables; names of functions and longer words are upright.
/// `_` and `^` take the word, the number or the {group} that follows.
std::vector<MathPart> math_parts(const std::string& math);

/// Finds symbols in prose: in "growth at 1.01 λ_crit on fandisk_ns" λ_crit becomes a math run. Only a Greek letter with
/// an index is a symbol; names of files and meshes have underscores too.
Text prose(const std::string& words);

}   // namespace meshfolio::report
