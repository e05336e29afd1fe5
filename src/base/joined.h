#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio {

/// "a, b, c" for `between` ", ".
inline std::string joined(const std::vector<std::string>& parts, std::string_view between) {
    std::string text;
    for (const std::string& part : parts) {
        if (!text.empty()) text += between;
        text += part;
    }
    return text;
}

}   // namespace meshfolio
