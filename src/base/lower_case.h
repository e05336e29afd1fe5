/// @file
/// Small letters, of ASCII alone whatever the locale.
#pragma once

#include <filesystem>
#include <string>

namespace meshfolio {

inline char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string lower_case(std::string text) {
    for (char& c : text) c = lower_case(c);
    return text;
}

/// The ending of a file's name with its dot: ".obj" of "Cow.OBJ".
inline std::string lower_case_ending(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

}   // namespace meshfolio
