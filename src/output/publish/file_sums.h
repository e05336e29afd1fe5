/// @file
/// The digests beside a report's files, as sha256sum writes and reads them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace meshfolio::output {

struct FileSum {
    std::string digest;   // SHA-256, 64 hexadecimal digits
    long line = 0;        // in the list
};

/// By path. Paths are not checked: check them before writing to them.
/// @param file  the list, for messages
/// @throws InputError with the line that is not of the format
std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file);

}   // namespace meshfolio::output
