/// @file
/// SHA-256 (FIPS 180-4), by nettle.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// The 32 bytes of the digest.
std::string sha256_bytes(std::string_view bytes);
/// The digest in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}   // namespace meshfolio
