/// @file
/// SHA256SUMS: lists the files of a folder that this program wrote, with their digests.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace meshfolio::output {

inline constexpr const char* sums_file = "SHA256SUMS";   // in the format of sha256sum

struct FileSum {
    std::string digest;   // SHA-256, 64 hexadecimal digits
    long line = 0;        // in the list, counted from 1
};

/// Parses the text of a SHA256SUMS: path → sum. Paths are not checked: check them before writing to them.
/// @param file  the name of the list in messages
/// @throws InputError naming the first line that is not in the format
std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file);

/// Path below a folder → digest.
using Digests = std::map<std::string, std::string>;

/// Returns the text of a SHA256SUMS, a line "digest  path" for each file, sorted by path.
std::string sums_text(const Digests& digests);

/// Writes the SHA256SUMS of all files below `folder` in one step. @param known  digests that need not be computed
/// @throws OutputError, InputError
void write_sums(const std::filesystem::path& folder, const Digests& known);

/// Returns the paths of all regular files below `folder`, relative to it and sorted.
std::vector<std::string> files_below(const std::filesystem::path& folder);

/// The contents of a SHA256SUMS. While several files change, it has a line for the old and one for the new version of each.
struct SumsList {
    bool is_there = false;   // as a regular file in the format
    std::set<std::string> paths;
    std::set<std::string> lines;   // "digest  path"

    bool has(const std::string& path, const std::string& digest) const { return lines.contains(digest + "  " + path); }
};

/// Reads the SHA256SUMS of `folder` without following a link. A damaged list counts as missing.
SumsList sums_of(const std::filesystem::path& folder);

/// Returns the alphabetically first path of the SHA256SUMS of `folder` that is missing or unreadable, leads outside or has another digest;
/// empty: none. A .gitignore does not count.
/// @throws InputError if there is no list
std::string first_changed(const std::filesystem::path& folder);

}   // namespace meshfolio::output
