#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "questions/core/chapter.h"
#include "report/writers.h"

namespace meshfolio::run {

/// Writes everything of the report but the pictures of meshes into `folder`: index.html, report.md, results.json, tables, plots, meshes.
/// @param stored  ids of sections whose tables, plots and meshes are there already
/// @throws OutputError
void write_report_files(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                        const report::WriteOptions& options, const std::vector<const Answer*>& answers, const std::set<std::string>& stored,
                        const std::filesystem::path& folder);

}   // namespace meshfolio::run
