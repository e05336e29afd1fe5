/// @file
/// Writes MathML: of displayed formulas from TeX, of formulas in a sentence from Unicode. Variables and small Greek letters are italic,
/// vectors bold, numbers, names and Greek capitals upright. A sign is a prefix at the beginning and behind an opening fence, a relation, a
/// comma or another operator. U+2061 follows a function. A pair of fences has an mrow of its own and grows only with tall contents.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// Returns the MathML of a displayed formula.
/// @param name  for messages
/// @param tex  letters, scripts, fences, \frac, \tfrac, \sqrt, \sum, \hat, \bar, \tilde, \text, \operatorname, \mathrm, \mathbf, \mathcal,
///             \boldsymbol, aligned, spaces, and the symbols listed in mathml.cpp
/// @param alt  the formula in plain text
/// @throws UsageError for an unknown command or a brace that is not closed
std::string display_mathml(const std::string& name, std::string_view tex, const std::string& alt);

/// Returns the MathML of a formula in a sentence. If it has more than 25 characters, lines may break behind its relations.
/// @param math  Unicode: "λ_crit = 2/μ_max"
std::string inline_mathml(const std::string& math);

}   // namespace meshfolio::report
