/// @file
/// Reads an untrusted folder or zip into memory: writes nothing, follows no links, executes nothing, and enforces limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace meshfolio::submission {

struct HandInLimits {
    int most_entries = 5000;
    std::uintmax_t largest_file = std::uintmax_t{64} << 20;   // of a file that is read, unpacked [bytes]
    std::uintmax_t largest_total = std::uintmax_t{256} << 20;
    /// Unpacked over packed size of the whole, once more than `ratio_from` bytes are unpacked: text seldom shrinks below 1 %, bombs do.
    double largest_ratio = 100;
    std::uintmax_t ratio_from = std::uintmax_t{8} << 20;
};

/// Path → bytes of all CSV, TOML and mesh files, by their endings in any case; of other files only the names are checked. If all files are
/// in one folder, paths are relative to it.
using HandedIn = std::map<std::string, std::string>;

/// Reads a folder or a zip.
/// @throws InputError for a path that leads outside or has backslashes, a link, a device, an entry that is encrypted or there twice, or a
/// limit that is exceeded
HandedIn read_handed_in(const std::filesystem::path& path, const HandInLimits& limits = {});

/// Reads a zip in memory; throws like read_handed_in(). @param file  its name in messages
HandedIn unpacked(std::string_view zip, const std::string& file, const HandInLimits& limits = {});

}   // namespace meshfolio::submission
