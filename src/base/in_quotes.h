#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// Returns the text in single quotes, made printable(); a text of more than `longest` bytes is cut between characters and ends in "…".
std::string in_quotes(std::string_view text, std::size_t longest = 40);

}   // namespace meshfolio
