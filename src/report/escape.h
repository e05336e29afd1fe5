/// @file
/// Makes arbitrary text, such as names of files and meshes, safe and valid for one format.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// A letter or a digit of ASCII, in any locale.
inline bool is_alphanumeric(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Valid UTF-8 on one line, of characters that XML 1.0 knows: line ends and tabs become spaces, other control characters, bidirectional
/// overrides and bytes that are not UTF-8 become visible escapes such as \xff.
std::string safe_text(const std::string& text);

/// The same text where it is UTF-8, U+FFFD where it is not. Line ends and control characters stay.
std::string valid_utf8(const std::string& text);

/// For element content and quoted attributes of HTML, SVG and XML.
std::string xml_escape(const std::string& text);

/// For running text, table cells, link texts and `<code>` of GitHub-flavoured Markdown. Addresses do not become links. Expects one line.
std::string markdown_escape(const std::string& text);

/// A relative path as a URL: every byte outside [A-Za-z0-9._~/-] percent-encoded.
std::string url_path(const std::string& path);

}   // namespace meshfolio::report
