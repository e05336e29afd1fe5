/// @file
/// Measures of a mesh by the keys of `inspect --json`, and conditions on them: "genus=0".
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "report/document.h"
#include "run/one_mesh/inspection.h"

namespace meshfolio::run {

/// Undefined, true or false, a number or a text.
using Measure = std::variant<std::monostate, bool, double, std::string>;

/// Returns the measures of an inspection by their keys: "genus", "gauss_bonnet.residual", "box_low.0"; of a list of objects their number.
std::map<std::string, Measure> measures_of(const Inspection& inspection);

/// Returns the key for a name with hyphens or underscores, with or without the ending "_deg".
/// @throws UsageError for an unknown name, with the nearest ones
std::string measure_key(const std::string& name);

/// Returns a measure as text with all digits: "yes", "12.5"; "" if it is undefined.
std::string text_of(const Measure& measure);

struct Condition {
    std::string text;      // as given: "smallest-angle>=5"
    std::string key;       // "smallest_angle_deg"
    std::string sign;      // = != < <= > >=
    double required = 1;   // 1 for true, 0 for false
    // The result on a mesh:
    Measure measured = {};
    bool holds = false;
    std::string reason = {};   // of an undefined measure
};

/// Parses conditions with commas between them: "closed,components=1,smallest-angle>=5".
/// @throws UsageError for an unknown name, a measure that is a text, or a value that is missing or of another type
std::vector<Condition> conditions_in(const std::string& text);

/// Enters what the mesh measures, and whether each condition holds; an undefined measure fails.
void try_on(const Inspection& inspection, std::vector<Condition>& conditions);

/// Returns a line for each condition in aligned columns: condition, measured value, "holds" or "FAILS".
std::string lines_of(const std::vector<Condition>& conditions);

/// Returns the JSON of `inspect --json`, with the conditions if there are any.
std::string inspection_json(const Inspection& inspection, const std::vector<Condition>& conditions);

/// Returns a report of one section, the mesh, with a check for each condition, for write_junit().
report::Document document_of(const std::vector<Condition>& conditions, const std::string& mesh);

}   // namespace meshfolio::run
