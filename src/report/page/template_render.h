/// @file
/// Renders Mustache templates with a JSON view model. Unknown tags are errors, where Mustache itself prints nothing.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "report/writers.h"

namespace meshfolio::report {

struct SyntaxProblem {
    std::string what;
    long line = 0;
};

/// Limits of templates. Messages name the limit that is exceeded.
namespace template_limits {
inline constexpr std::size_t largest_file = std::size_t{4} << 20;      // bytes
inline constexpr int deepest_sections = 32;                            // nested, in one file
inline constexpr int deepest_json = 64;                                // levels of a template that is JSON
inline constexpr int deepest_includes = 100;                           // of templates that {{>name}} includes
inline constexpr long long most_steps = 30'000'000;                    // texts and tags evaluated
inline constexpr std::size_t largest_print = std::size_t{256} << 20;   // bytes
}   // namespace template_limits

/// Returns the first syntax error of a Mustache template with its line, if any; also for deep nesting and changed delimiters.
std::optional<SyntaxProblem> syntax_problem(const std::string& text);

/// Returns the template `name`, filled in with the values of a view model.
/// @param escape  applied to the text of {{tag}}, not to that of {{{tag}}}
/// @throws UsageError with template and line for a tag that the model does not know, or for a template beyond the limits
std::string render(const Templates& templates, const std::string& name, const nlohmann::json& model,
                   const std::function<std::string(const std::string&)>& escape);

}   // namespace meshfolio::report
