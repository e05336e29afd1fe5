/// @file
/// [original] and [[experiment]] of a settings file: the experiments of earlier reports.
#pragma once

#include <vector>

#include "cli/settings_reader.h"
#include "questions/experiment.h"

namespace meshfolio::cli {

/// The experiments in the order of the file; what is wrong is reported.
std::vector<Experiment> read_experiments(const toml::table& root, Problems& problems);

}   // namespace meshfolio::cli
