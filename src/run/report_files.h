/// @file
/// A report as files, and what it did not achieve in a few lines for the terminal.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "questions/core/chapter.h"
#include "report/document.h"
#include "report/writers.h"

namespace meshfolio::run {

/// Writes everything of the report but the pictures of meshes into `folder`: the pages
/// and the Markdown of both volumes, summary.md, results.json, tables, plots, meshes.
/// @param stored  ids of sections whose tables, plots and meshes are there already
/// @throws OutputError
void write_report_files(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                        const report::WriteOptions& options, const std::vector<const Answer*>& answers, const std::set<std::string>& stored,
                        const std::filesystem::path& folder);

/// Has a section or a check failed? What is undecided is no failure.
bool has_failed(const report::Document& document);

/// Warnings, failures, failed checks and the number of undecided ones, on stderr.
void summarise(const report::Document& document);

}   // namespace meshfolio::run
