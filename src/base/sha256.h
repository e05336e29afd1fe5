/// @file
/// SHA-256 digests (FIPS 180-4).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace meshfolio {

/// Returns the digest as 32 raw bytes.
std::string sha256_bytes(std::string_view bytes);
/// Returns the digest as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);
/// Returns the digest of a file's bytes as 64 hexadecimal digits. @throws InputError if the file cannot be read
std::string sha256_of_file(const std::filesystem::path& path);

}   // namespace meshfolio
