/// @file
/// On which line of a JSON text something stands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace meshfolio::report {

/// The line of the value at `path` ("questions[0].title"), counted from 1; 0 if it is not found.
long line_of_json(std::string_view text, const std::string& path);

/// The line of a byte, counted from 1.
long line_of_byte(std::string_view text, std::size_t byte);

}   // namespace meshfolio::report
