/// @file
/// One report of a batch, made by a child process.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/child_process.h"
#include "run/batch/batch.h"
#include "run/batch/mesh_list.h"

namespace meshfolio::run {

/// Returns the arguments `report MESH …` with the flags of the batch. @param more  arguments for this run alone
std::vector<std::string> report_words(const BatchFlags& flags, const BatchMesh& mesh, const std::vector<std::string>& more);

/// Runs this program with these arguments in the current folder. The child ends when this process ends.
ChildEnd run_this_program(const std::vector<std::string>& words);

/// Returns the number of vertices of the first mesh in the output of `report --plan --json`; 0 if no section needs a mesh, nothing if the
/// output holds no plan.
std::optional<double> planned_vertices(const std::string& output);

/// Returns in one line why a child failed: its last message without "meshfolio: ", else how it ended.
std::string failure_of(const ChildEnd& end);

}   // namespace meshfolio::run
