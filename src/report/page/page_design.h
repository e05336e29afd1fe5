/// @file
/// Style sheets and scripts of a page design, and the content security policy that allows only these.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

struct DesignParts {
    bool models = false;            // some figure can be turned: adds the styles and the script
    std::string_view viewer = {};   // the program that turns them, as data; empty: models are only linked
    std::vector<Lab> labs = {};     // meshes of the laboratory, for the same program
};

/// Fills `style`, `scheme_script`, `script`, `viewer`, `labs` and `policy` of a view model for `design`.html; "lab" is the laboratory
/// alone, "batch" the index of many reports.
/// @throws UsageError for a text that would end its element
void add_design(nlohmann::json& model, const Templates& templates, const std::string& design, const DesignParts& parts = {});

/// Packs bytes for a page: zlib, then base64. The browser unpacks them itself (atob, DecompressionStream).
std::string packed(std::string_view bytes);

}   // namespace meshfolio::report
