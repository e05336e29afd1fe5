/// @file
/// Text from anywhere made safe for one format. Names of files and meshes may hold anything; what leaves here is valid.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

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

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}   // namespace meshfolio::report
