/// @file
/// What a page carries so that its models can be turned.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// The script bundled from templates/viewer; empty when the program was built without it.
std::string_view viewer_program();

/// Bytes that lie in a page as data: zlib, then base64. The browser takes both off by itself (atob, DecompressionStream).
std::string packed(std::string_view bytes);

}   // namespace meshfolio::report
