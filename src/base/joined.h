#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio {

/// Joins the parts with `between`: "a, b, c" for ", ".
inline std::string joined(const std::vector<std::string>& parts, std::string_view between) {
    std::string text;
    for (const std::string& part : parts) {
        if (!text.empty()) text += between;
        text += part;
    }
    return text;
}

/// Returns "a, b, c and 5 more" for a message: the first twelve names, each cut after 80 bytes, and the number of the others.
inline std::string first_of_many(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12, longest = 80;
    std::vector<std::string> shown(names.begin(), names.size() > most ? names.begin() + most : names.end());
    for (std::string& name : shown)
        if (name.size() > longest) name = name.substr(0, longest) + "...";
    return joined(shown, ", ") + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
}

}   // namespace meshfolio
