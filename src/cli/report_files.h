#pragma once

#include <filesystem>
#include <vector>

#include "questions/question.h"
#include "report/writers.h"

namespace meshfolio::cli {

/// Writes everything of the report but the pictures of meshes into `folder`: index.html, report.md, results.json, tables, plots, meshes.
/// @throws OutputError
void write_report_files(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                        const report::WriteOptions& options, const std::vector<Answer>& answers, const std::filesystem::path& folder);

}   // namespace meshfolio::cli
