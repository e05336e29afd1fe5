/// @file
/// Base64 (RFC 4648, with padding).
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// Returns the bytes as base64 with padding: "Zm8=" for "fo".
std::string base64(std::string_view bytes);

/// Returns the bytes of a base64 text, in which white space may stand; "" if any other part of it is not base64.
std::string from_base64(std::string_view text);

/// Decodes the first `count` bytes of a text that joins several encodings, each with or without "=" at its end; white space may stand
/// anywhere. Returns fewer bytes if the text ends early or stops being base64.
std::string from_base64_parts(std::string_view text, std::size_t count);

}   // namespace meshfolio
