/// @file
/// One report by a run of this program of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/pdf/child_process.h"
#include "run/batch/batch.h"
#include "run/batch/mesh_list.h"

namespace meshfolio::run {

/// `report MESH …` with what a batch was asked for. @param more  words for this run alone
std::vector<std::string> report_words(const BatchFlags& flags, const BatchMesh& mesh, const std::vector<std::string>& more);

/// Runs this program with these words, here. It ends when this process does.
report::ChildEnd run_this_program(const std::vector<std::string>& words);

/// Vertices of the mesh in the output of `report --plan --json`, if it names one.
std::optional<double> planned_vertices(const std::string& output);

/// The reason of the failure, in one line.
std::string failure_of(const report::ChildEnd& end);

}   // namespace meshfolio::run
