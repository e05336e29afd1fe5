/// @file
/// [original] and [[experiment]] of a settings file: the experiments of earlier reports.
#pragma once

#include <vector>

#include "questions/core/experiment.h"
#include "run/settings/settings_reader.h"

namespace meshfolio::run {

/// The experiments in the order of the file; what is wrong is reported.
std::vector<Experiment> read_experiments(const toml::table& root, Problems& problems);

}   // namespace meshfolio::run
