/// @file
/// Makes arbitrary text, such as names of files and meshes, safe for one format.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// Returns the text as valid UTF-8 on one line, in characters of XML 1.0: line ends and tabs become spaces; other control characters,
/// bidirectional overrides and bytes that are not UTF-8 become an escape of each byte, such as \xff; U+FFFE and U+FFFF become U+FFFD.
std::string safe_text(const std::string& text);

/// Replaces & < > " ' by entities, for element content and quoted attributes of HTML, SVG and XML.
std::string xml_escape(const std::string& text);

/// Puts backslashes and entities into one line, for running text, table cells, link texts and `<code>` of GitHub-flavoured Markdown.
/// Addresses do not become links.
std::string markdown_escape(const std::string& text);

/// Returns a path as a URL: every byte outside [A-Za-z0-9._~/-] is percent-encoded.
std::string url_path(const std::string& path);

}   // namespace meshfolio::report
