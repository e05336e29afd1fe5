/// @file
/// Displayed formulas and cited works: lists that are templates, so that users can replace them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

struct FormulaForms {
    std::string tex, mathml, plain;
};

/// templates/formulas.json by name.
/// @throws UsageError if a replaced file is not of that shape
std::map<std::string, FormulaForms> formulas_of(const Templates& templates);

struct CitedWork {
    std::string id;   // "desbrun_1999", to be cited with ref("desbrun_1999")
    std::string authors, year, title, where;
};

/// templates/references.json in the order of their numbers.
/// @throws UsageError if a replaced file is not of that shape
std::vector<CitedWork> bibliography_of(const Templates& templates);

}   // namespace meshfolio::report
