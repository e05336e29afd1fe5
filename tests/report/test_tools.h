/// @file
/// Tools of the report tests: programs, text searched, no number.
#pragma once

#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace meshfolio::report {

using testing_tools::TemporaryFolder;

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

inline bool has_program(const std::string& name) { return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0; }

inline bool succeeds(const std::string& command) { return std::system(command.c_str()) == 0; }

inline bool is_well_formed(const std::string& xml) {
    const TemporaryFolder folder;
    return succeeds("xmllint --noout '" + folder.write("text.xml", xml).string() + "'");
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
    return count;
}

/// Returns all matches of the first group of the expression in the text.
std::vector<std::string> matches(const std::string& text, const std::string& expression);

/// A page without its scripts, styles and pictures, for searches that mean the text.
inline std::string body_of(const std::string& html) { return html.substr(html.find("<body>")); }

}   // namespace meshfolio::report
