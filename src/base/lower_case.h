/// @file
/// Conversion to lower case, of ASCII letters only, whatever the locale.
#pragma once

#include <filesystem>
#include <string>

namespace meshfolio {

inline char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string lower_case(std::string text) {
    for (char& c : text) c = lower_case(c);
    return text;
}

/// Returns the extension of a file's name in lower case, with its dot: ".obj" for "Cow.OBJ".
inline std::string lower_case_ending(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

}   // namespace meshfolio
