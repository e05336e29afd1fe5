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
    std::uintmax_t largest_file = std::uintmax_t{64} << 20;   // unpacked, of those that are read [bytes]
    std::uintmax_t largest_total = std::uintmax_t{256} << 20;
    /// Unpacked over packed, of the whole, where more than `ratio_from` bytes come out: text seldom shrinks below 1 %, a bomb always does.
    double largest_ratio = 100;
    std::uintmax_t ratio_from = std::uintmax_t{8} << 20;
};

/// Path → bytes of all files with one of our endings: .csv .toml .obj .off .ply .stl, in any case. Others are looked at no further than
/// their names. If all files are in one folder, paths are relative to it.
using HandedIn = std::map<std::string, std::string>;

/// @throws InputError naming what is wrong: a path that leads outside or, in a folder, has backslashes, a link, a device, an entry that
/// stands twice or is encrypted, and what is beyond the limits
HandedIn read_handed_in(const std::filesystem::path& path, const HandInLimits& limits = {});

/// The same of a zip in memory. @param file  what messages call it
HandedIn unpacked(std::string_view zip, const std::string& file, const HandInLimits& limits = {});

}   // namespace meshfolio::submission
