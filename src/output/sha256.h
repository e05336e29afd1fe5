#pragma once

#include <string>
#include <string_view>

namespace meshfolio::output {

/// Hexadecimal SHA-256.
std::string sha256(std::string_view bytes);

}   // namespace meshfolio::output
