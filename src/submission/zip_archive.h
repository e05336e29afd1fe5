/// @file
/// A ZIP file whose bytes depend on nothing but its entries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::submission {

struct ZipEntry {
    std::string path;
    std::string_view bytes;
    bool executable = false;   // mode 0755; else 0644
};

/// The archive, in the order of the entries, deflated, without owners and times (readers show 1 January 1980).
/// @throws OutputError if libarchive cannot
std::string zip_of(const std::vector<ZipEntry>& entries);

}   // namespace meshfolio::submission
