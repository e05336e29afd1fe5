/// @file
/// Bytes as text (RFC 4648, with padding).
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

std::string base64(std::string_view bytes);

/// The bytes; empty where the text is not base64, or not all of it.
std::string from_base64(std::string_view text);

}   // namespace meshfolio
