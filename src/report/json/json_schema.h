/// @file
/// The JSON schema (draft 7) of results.json, made from the descriptions that write and read it (json_fields.h).
#pragma once

#include <string>

namespace meshfolio::report {

const std::string& results_schema();

}   // namespace meshfolio::report
