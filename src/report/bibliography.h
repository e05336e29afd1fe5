/// @file
/// Displayed formulas and cited works, from templates that users can replace.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

struct FormulaForms {
    std::string tex, mathml, plain;
};

/// Returns the formulas of templates/formulas.json by name. MathML that the file does not give is made from the TeX.
/// @throws UsageError if a replaced file has another structure
std::map<std::string, FormulaForms> formulas_of(const Templates& templates);

struct CitedWork {
    std::string id;   // "desbrun_1999", cited by ref("desbrun_1999")
    std::string authors, year, title, where;
};

/// Returns the works of templates/references.json in their order.
/// @throws UsageError if a replaced file has another structure
std::vector<CitedWork> bibliography_of(const Templates& templates);

}   // namespace meshfolio::report
