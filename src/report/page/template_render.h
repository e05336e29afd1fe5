/// @file
/// Renders Mustache templates with a JSON view model. Unknown tags are errors; Mustache itself would print nothing.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

struct SyntaxProblem {
    std::string what;
    long line = 0;
};

/// Limits of templates. The message about an excess names the limit.
namespace template_limits {
inline constexpr std::size_t largest_file = std::size_t{4} << 20;      // bytes
inline constexpr int deepest_sections = 32;                            // within one another, in one file
inline constexpr int deepest_json = 64;                                // levels of a template that is JSON
inline constexpr int deepest_includes = 100;                           // {{>name}} in what {{>name}} brings
inline constexpr long long most_steps = 30'000'000;                    // texts and tags evaluated
inline constexpr std::size_t largest_print = std::size_t{256} << 20;   // bytes
}   // namespace template_limits

/// The first syntax error of a template, if any.
std::optional<SyntaxProblem> syntax_problem(const std::string& text);

/// A tag and its place in a template.
struct Tag {
    std::string file;
    long line = 0;
    std::size_t position = 0;   // in the file
    std::string name;
    auto operator<=>(const Tag&) const = default;
};

struct TagUse {
    std::vector<Tag> unknown;     // evaluated, and nothing in the model has this name
    std::vector<Tag> unreached;   // never evaluated with this model: in a section that is empty
};

/// Evaluates every tag of a template, and of those it includes with {{>name}}, as rendering would.
TagUse use_of_tags(const Templates& templates, const std::string& name, const nlohmann::json& model);

/// @param escape  applied to what {{tag}} prints, not to {{{tag}}}
/// @throws UsageError naming template and line of a tag that the model does not know
std::string render(const Templates& templates, const std::string& name, const nlohmann::json& model,
                   const std::function<std::string(const std::string&)>& escape);

}   // namespace meshfolio::report
