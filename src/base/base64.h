/// @file
/// Bytes as text (RFC 4648, with padding).
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

std::string base64(std::string_view bytes);

/// The bytes; empty where the text is not base64, or not all of it.
std::string from_base64(std::string_view text);

/// The first `count` bytes of parts in base64 one after the other, each filled up with "=" or not, with blanks and line ends anywhere.
/// @return fewer where the text ends, or is no base64 from there on
std::string from_base64_parts(std::string_view text, std::size_t count);

}   // namespace meshfolio
