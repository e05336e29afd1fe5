#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// True if the bytes begin as gzip data do.
inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// Unpacks gzip data, of several members too.
/// @throws InputError about `file` if the data are damaged or cut off, or unpack to more than 25 times their size and a megabyte, or to
/// more
///         than `largest_file`
std::string gunzipped(std::string_view bytes, const std::string& file);

}   // namespace meshfolio
