/// @file
/// Pieces of an input in messages.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// A piece of the input within quotes, for messages: harmless to print, and cut when it is longer than `longest` bytes.
std::string in_quotes(std::string_view text, std::size_t longest = 40);

}   // namespace meshfolio
