/// @file
/// On which line of a JSON text something stands.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace meshfolio::report {

/// The line of the value at `path` ("questions[0].title"), counted from 1; 0 if it is not found.
long line_of_json(std::string_view text, const std::string& path);

/// The first bracket or brace nested deeper than `levels`, if any. Check this first wherever JSON values are processed recursively.
std::optional<std::size_t> deeper_than(int levels, std::string_view text);

/// The line of a byte, counted from 1.
long line_of_byte(std::string_view text, std::size_t byte);

}   // namespace meshfolio::report
