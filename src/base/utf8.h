/// @file
/// Decodes UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace meshfolio {

struct CodePoint {
    char32_t value = 0;
    std::size_t length = 0;   // bytes; 0: not UTF-8
};

/// Returns the code point whose first byte is at `at`, which is inside the text. Length 0 if the bytes there are not UTF-8, as overlong
/// forms and surrogates (RFC 3629).
CodePoint code_point_at(std::string_view text, std::size_t at);

}   // namespace meshfolio
