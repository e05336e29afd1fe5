/// @file
/// The one writer of MathML: displayed formulas from TeX, formulas in a sentence from the Unicode they are written in. One convention holds
/// for both: variables and small Greek letters are italic, vectors bold, numbers, names and Greek capitals upright. A sign at the
/// beginning, or behind a fence that opens, a relation, a comma or another operator, belongs to what follows it; a function is followed by
/// U+2061; fences come in pairs, each in an mrow of its own, and grow only with what is tall.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// @param name  for messages
/// @param tex  letters, scripts, fences, \frac, \tfrac, \sqrt, \sum, \hat, \bar, \tilde, \text, \operatorname, \mathrm, \mathbf, \mathcal,
///             \boldsymbol, aligned, spaces, and the symbols listed in mathml.cpp
/// @param alt  the same in plain text
/// @throws UsageError naming what is not known, or the brace that is not closed
std::string display_mathml(const std::string& name, std::string_view tex, const std::string& alt);

/// @param math  as in the words: "λ_crit = 2/μ_max". Lines may be broken behind the relations of a long one.
std::string inline_mathml(const std::string& math);

}   // namespace meshfolio::report
