/// @file
/// What `meshfolio report` was asked for: flags over settings file over environment over defaults.
#pragma once

#include <tbb/global_control.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "questions/core/settings.h"
#include "run/settings/settings_file.h"

namespace meshfolio::run {

/// As given on the command line; what is empty was not.
struct ReportFlags {
    std::vector<std::string> meshes, data;
    std::string only, out, config, threads, size, templates, pdf, pdf_browser, from;
    bool quick = false, fail_fast = false, no_timings = false, no_cache = false;
};

struct ReportSettings {
    std::vector<std::filesystem::path> meshes, data;
    std::filesystem::path out = "out", templates;
    std::optional<std::filesystem::path> page_template;
    std::string design = "report";           // of the page, bundled
    std::string pdf = "auto", pdf_browser;   // auto, require or off; the browser by name or path, empty: the first that is found
    report::Extent printed = report::Extent::brief;
    std::string title, author, course, colormap;
    int width = 0, height = 0;   // of one view [pixels]
    int threads = 0;             // 0: all
    std::uint64_t seed = 0;
    bool quick = false, laboratory = false, fail_fast = false, timings = true;
    std::vector<std::string> only;                    // ids; empty: all
    std::map<std::string, QuestionTable> questions;   // by id
    std::vector<Experiment> experiments;              // of earlier reports; empty: the brief ones of the bundled files
    std::string experiments_digest;                   // of the file they come from
    std::filesystem::path base;                       // what the meshes of `questions` are relative to
};

/// @throws SettingsErrors, UsageError
ReportSettings report_settings(const ReportFlags& flags);

/// For as long as it lives, no more threads work than are asked for; null where all may.
std::unique_ptr<tbb::global_control> limited_threads(const ReportSettings& settings);

/// The settings file of that name, else the bundled one of data/reports.
/// @throws SettingsErrors
SettingsFile named_settings(const std::string& config);

/// Those of one question.
QuestionSettings question_settings(const ReportSettings& settings, const std::string& id);

/// The meshes of all questions, in order: their names must not depend on which question reads first.
std::vector<std::filesystem::path> listed_meshes(const ReportSettings& settings);

/// For the provenance: everything that shapes the results, without threads and paths.
std::map<std::string, std::string> described(const ReportSettings& settings);

}   // namespace meshfolio::run
