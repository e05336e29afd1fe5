#include "output/publish/safe_name.h"

#include <algorithm>

namespace meshfolio::output {

bool is_safe_name(std::string_view name) {
    const auto safe = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '+' || c == '-';
    };
    return !name.empty() && name.size() <= 120 && name.front() != '.' && name.front() != '-' && std::all_of(name.begin(), name.end(), safe);
}

}   // namespace meshfolio::output
