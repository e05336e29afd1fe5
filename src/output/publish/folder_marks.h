/// @file
/// Marker files in the folders that this program makes, and the folders that it may replace.
#pragma once

#include <filesystem>

namespace meshfolio::output {

inline constexpr const char* marker_file = ".meshfolio";   // of a report

/// A kind of folder that this program makes. A folder is never replaced by one of another kind.
struct FolderKind {
    const char* marker;     // name of the marker file
    const char* words;      // for messages
    const char* contents;   // of the marker file
};
inline constexpr const char* replaced_as_a_whole = "This folder was made by meshfolio, which replaces it as a whole.\n";
inline constexpr FolderKind report_folder{marker_file, "a report", replaced_as_a_whole},
    marks_folder{".meshfolio-marks", "the marks of a class", replaced_as_a_whole},
    batch_folder{".meshfolio-batch", "the reports of a batch",
                 "This folder was made by meshfolio batch: a report in each folder, index.html tells of all.\n"};

/// True if the folder has the marker of this kind, a regular file with these contents; false if it cannot be read.
bool has_mark(const std::filesystem::path& folder, const FolderKind& kind) noexcept;

/// True if the folder has a marker of any kind.
bool is_marked(const std::filesystem::path& folder) noexcept;

/// Requires that a command may replace or fill `target`: it is missing, has the marker of this kind, or holds a .gitignore at most.
/// @throws OutputError otherwise, and for a home folder
void require_ours(const std::filesystem::path& target, const FolderKind& kind);

}   // namespace meshfolio::output
