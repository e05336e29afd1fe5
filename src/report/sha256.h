/// @file
/// SHA-256 (FIPS 180-4), for the hashes of inline style and script in a Content-Security-Policy.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// The 32 bytes of the digest.
std::string sha256(std::string_view bytes);

}   // namespace meshfolio::report
