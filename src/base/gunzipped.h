#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// True if the bytes begin as gzip data do.
inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// Unpacks gzip data, of several members too.
/// @throws InputError about `file` if the data are damaged, or unpack to more than 1 MB + 25 times their size or than `largest_file`
std::string gunzipped(std::string_view bytes, const std::string& file);

}   // namespace meshfolio
