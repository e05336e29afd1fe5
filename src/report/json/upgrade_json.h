/// @file
/// results.json of earlier versions, brought to the present one before it is read.
#pragma once

#include "report/json/json_writer.h"

namespace meshfolio::report {

/// From version to version. What is not as it should be is left to the reader.
/// @throws JsonProblem for what is no results.json, or of a version that cannot be brought up
void upgrade_json(Json& results);

}   // namespace meshfolio::report
