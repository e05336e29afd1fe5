/// @file
/// SHA-256 (FIPS 180-4), by nettle.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace meshfolio {

/// The 32 bytes of the digest.
std::string sha256_bytes(std::string_view bytes);
/// The digest in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
/// The same of a file, however large. @throws InputError if it cannot be read
std::string sha256_of_file(const std::filesystem::path& path);

}   // namespace meshfolio
