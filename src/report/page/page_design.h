/// @file
/// Style sheets and scripts of a page, and the content security policy that allows only these.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

struct DesignParts {
    bool models = false;            // adds styles and script for figures that can be turned
    std::string_view viewer = {};   // program that turns them; empty: the page only links to models
    std::vector<Lab> labs = {};     // meshes of the laboratory, for the same program
};

/// Adds style, scheme_script, script, viewer, labs, policy and is_screen to a view model for the template <design>.html.
/// @throws UsageError for a style sheet or script with "</style", "</script", "<!--" or "]]>"
void add_design(nlohmann::json& model, const Templates& templates, const std::string& design, const DesignParts& parts = {});

/// Returns bytes compressed by zlib, as base64. Browsers unpack them by atob and DecompressionStream.
std::string packed(std::string_view bytes);

}   // namespace meshfolio::report
