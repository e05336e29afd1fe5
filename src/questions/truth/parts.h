/// @file
/// The parts of the chapter "truth", which `meshfolio verify` writes too.
#pragma once

#include "questions/bench/ground_truth.h"
#include "report/document.h"

namespace meshfolio::truth {

/// The whole section, checks included.
report::Section ground_truth_section(const GroundTruth& truth);

/// One row an estimate on every mesh, with everything that was measured: for files.
report::Table ground_truth_table(const GroundTruth& truth);

}   // namespace meshfolio::truth
