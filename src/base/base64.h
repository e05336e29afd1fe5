/// @file
/// Base64 (RFC 4648, with padding).
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// Encodes bytes: "fo" becomes "Zm8=".
std::string base64(std::string_view bytes);

/// Decodes a text; returns "" if any part of it is not base64.
std::string from_base64(std::string_view text);

/// Decodes the first `count` bytes of a text that joins several encodings, each with or without "=" at its end; white space may stand
/// anywhere. Returns fewer bytes if the text ends early or stops being base64.
std::string from_base64_parts(std::string_view text, std::size_t count);

}   // namespace meshfolio
