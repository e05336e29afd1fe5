#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// True if the bytes begin with 1f 8b, the signature of gzip.
inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// Returns the unpacked bytes of gzip data, all members one after the other.
/// @throws InputError about `file` if the data are damaged, or unpack to more than 1 MB + 25 times their size or than `largest_file`
std::string gunzipped(std::string_view bytes, const std::string& file);

}   // namespace meshfolio
