/// @file
/// Lines of a JSON text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace meshfolio::report {

/// Returns the line, counted from 1, of the value at `path` ("questions[0].title") in JSON without errors; 0 if there is no such value.
long line_of_json(std::string_view text, const std::string& path);

/// Returns the byte position of the first opening bracket or brace nested deeper than `levels`, if any; to be checked before JSON from
/// outside is parsed.
std::optional<std::size_t> deeper_than(int levels, std::string_view text);

/// Returns the line of the byte at position `byte`, counted from 1.
long line_of_byte(std::string_view text, std::size_t byte);

}   // namespace meshfolio::report
