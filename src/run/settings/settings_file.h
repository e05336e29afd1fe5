/// @file
/// The settings of `meshfolio report` from TOML. Strict: every key is known, of its type and within its limits, or the file is refused with
/// everything that is wrong in it at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "questions/core/settings.h"
#include "report/page/view_model.h"
#include "run/settings/settings_errors.h"

namespace meshfolio::run {

/// [[question]]: what was given is set, the rest stays with the question.
struct QuestionTable {
    std::vector<std::string> meshes;
    std::vector<int> k, iterations;
    std::vector<double> lambda, noise;
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;
    std::optional<std::string> output;   // folder of the output meshes
};

/// A settings file; keys that are not there are nothing.
struct SettingsFile {
    std::optional<std::string> title, author, course;
    std::vector<std::string> sections;                    // ids of the questions to answer; empty: all
    std::optional<std::filesystem::path> page_template;   // absolute or relative to where the program runs
    std::optional<std::string> design;                    // of the page, bundled
    std::optional<report::Extent> printed;                // in the PDF
    std::optional<int> width, height;                     // of one view [pixels]
    std::optional<std::string> colormap;
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;   // 0: all
    std::optional<bool> laboratory;
    std::map<std::string, QuestionTable> questions;   // by id
    std::vector<Experiment> experiments;              // of earlier reports, in the order of the file
    std::filesystem::path folder;                     // of the file: meshes are relative to it
    std::string digest;                               // SHA-256 of the text
};

/// @throws SettingsErrors, also for a file that cannot be read
SettingsFile read_settings(const std::filesystem::path& path);

/// The same from memory; `file` stands in the messages and its folder is what paths are relative to.
SettingsFile parse_settings(std::string_view text, const std::string& file);

}   // namespace meshfolio::run
