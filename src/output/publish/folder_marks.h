/// @file
/// The marks by which folders made by us are known, and which folders may be replaced.
#pragma once

#include <filesystem>

namespace meshfolio::output {

/// The marker file of a report made by us.
inline constexpr const char* marker_file = ".meshfolio";

/// A kind of folder that is ours. None takes the place of one of another kind.
struct FolderKind {
    const char* marker;     // name of the mark: a regular file
    const char* words;      // in messages
    const char* contents;   // of the mark, to the byte
};
inline constexpr const char* replaced_as_a_whole = "This folder was made by meshfolio, which replaces it as a whole.\n";
inline constexpr FolderKind report_folder{marker_file, "a report", replaced_as_a_whole},
    marks_folder{".meshfolio-marks", "the marks of a class", replaced_as_a_whole},
    batch_folder{".meshfolio-batch", "the reports of a batch",
                 "This folder was made by meshfolio batch: a report in each folder, index.html tells of all.\n"};

/// Returns whether the folder has the mark of this kind: a regular file with our contents. False if it cannot be read.
bool has_mark(const std::filesystem::path& folder, const FolderKind& kind) noexcept;

/// Returns whether the folder has a mark of any kind.
bool is_marked(const std::filesystem::path& folder) noexcept;

/// Checks that a command may replace or fill `target`.
/// @throws OutputError for a home folder, and for one that holds something without the mark of this kind; a .gitignore may be there
void require_ours(const std::filesystem::path& target, const FolderKind& kind);

}   // namespace meshfolio::output
