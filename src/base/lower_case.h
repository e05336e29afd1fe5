/// @file
/// Letters and digits of ASCII, in any locale.
#pragma once

#include <filesystem>
#include <string>

namespace meshfolio {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
inline bool is_alphanumeric(char c) { return is_letter(c) || is_digit(c); }

inline char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string lower_case(std::string text) {
    for (char& c : text) c = lower_case(c);
    return text;
}

/// Returns the extension of a file's name in lower case, with its dot: ".obj" for "Cow.OBJ".
inline std::string lower_case_ending(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

}   // namespace meshfolio
