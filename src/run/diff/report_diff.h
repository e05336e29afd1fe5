/// @file
/// The changes between two reports or two batches: of documents, pictures and meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/changes.h"

namespace meshfolio::run {

/// A picture of both reports, as JPEG, for a page.
struct PicturePair {
    std::string path;   // "images/q1_plane_h_sheet.png"
    std::string before, after;
    int width = 0, height = 0;
};

struct ReportDiff {
    std::string before, after;   // as the user named them
    std::vector<report::Change> changes = {};
    report::ComparedParts compared = {};
    std::vector<report::Section> sections = {};   // of the new report, for their checks
    std::vector<PicturePair> pictures = {};       // that differ, the largest differences first
};

/// Compares two reports: folders, or files results.json, of which the documents alone are compared; or two folders of `batch`, mesh by
/// mesh.
/// @param with_pictures  also keeps the pictures that differ, at most `most_pictures` of them
/// @throws InputError if one is no report, or one is a batch and the other is not
ReportDiff diff_of(const std::filesystem::path& before, const std::filesystem::path& after, double tolerance, bool with_pictures);

inline constexpr std::size_t most_pictures = 40;

/// Returns the changes as text for people: a line for each, at most 20 of a kind, and a last line with the counts.
std::string diff_text(const ReportDiff& diff);
/// Returns all changes as JSON.
std::string diff_json(const ReportDiff& diff);
/// Returns JUnit XML: a case for each check of the new report and for each table, picture and mesh that changed; a changed one is a
/// failure.
std::string diff_junit(const ReportDiff& diff);
/// Returns an HTML page: old and new side by side, pictures under a slider.
std::string diff_page(const ReportDiff& diff);

}   // namespace meshfolio::run
