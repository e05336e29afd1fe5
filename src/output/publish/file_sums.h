/// @file
/// SHA256SUMS: which files of a folder are ours, and what they were when we wrote them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace meshfolio::output {

/// Digests of every other file of ours, in the format of sha256sum.
inline constexpr const char* sums_file = "SHA256SUMS";

/// One line of it.
struct FileSum {
    std::string digest;   // SHA-256, 64 hexadecimal digits
    long line = 0;        // in the list
};

/// By path. Paths are not checked: check them before writing to them.
/// @param file  the list, for messages
/// @throws InputError with the line that is not of the format
std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file);

/// Digests that are known already, by path below the folder.
using Digests = std::map<std::string, std::string>;

/// Returns the list as sha256sum writes it.
std::string sums_text(const Digests& digests);

/// Lists every file below `folder` in its SHA256SUMS, which is there whole or not at all. @throws OutputError, InputError
void write_sums(const std::filesystem::path& folder, const Digests& known);

/// Files below `folder`, relative to it, sorted by their bytes.
std::vector<std::string> files_below(const std::filesystem::path& folder);

/// What SHA256SUMS says of a folder. During a change of several files it has a line for the old and one for the new of each.
struct SumsList {
    bool is_there = false;   // a regular file of the format
    std::set<std::string> paths;
    std::set<std::string> lines;   // "digest  path"

    bool has(const std::string& path, const std::string& digest) const { return lines.contains(digest + "  " + path); }
};

/// Reads the list without following a link. One that is damaged counts as missing.
SumsList sums_of(const std::filesystem::path& folder);

/// Returns the first listed path that is missing or has another digest; empty: all are as they were written.
/// @throws InputError where there is no list
std::string first_changed(const std::filesystem::path& folder);

}   // namespace meshfolio::output
