/// @file
/// Data that gzip has packed.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// All that is packed, of several members one after the other.
/// @throws InputError about `file` where the data is damaged or cut off, or grows to more than 300 times its size and a megabyte, or to
///         more than a file may have
std::string gunzipped(std::string_view bytes, const std::string& file);

}   // namespace meshfolio
