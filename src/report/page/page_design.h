/// @file
/// What a design of the page has besides its markup: style sheets, scripts, and the policy that allows just these.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/writers.h"

namespace meshfolio::report {

struct DesignParts {
    bool models = false;            // some figure can be turned: styles and script for that come along
    std::string_view viewer = {};   // the program they are turned by, carried as data; empty: they are only linked to
    std::vector<Lab> labs = {};     // meshes of the laboratory, for the same program
};

/// Fills `style`, `scheme_script`, `script`, `viewer`, `labs` and `policy` of a view model for `design`.html; "lab" is the laboratory
/// alone, "batch" the index of many reports.
/// @throws UsageError for a text that would end its element
void add_design(nlohmann::json& model, const Templates& templates, const std::string& design, const DesignParts& parts = {});

/// Packs bytes for a page: zlib, then base64. The browser unpacks them itself (atob, DecompressionStream).
std::string packed(std::string_view bytes);

}   // namespace meshfolio::report
