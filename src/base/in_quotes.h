#pragma once

#include <string>
#include <string_view>

namespace meshfolio {

/// Returns the text in single quotes, safe to print, with "…" in place of what exceeds `longest` bytes.
std::string in_quotes(std::string_view text, std::size_t longest = 40);

}   // namespace meshfolio
