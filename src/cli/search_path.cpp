#include "cli/search_path.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace meshfolio::cli {

std::optional<std::filesystem::path> found_on_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    for (std::string_view rest = path != nullptr ? path : ""; !rest.empty();) {
        const std::size_t colon = std::min(rest.find(':'), rest.size());
        const std::filesystem::path candidate = std::filesystem::path(rest.substr(0, colon)) / program;
        if (std::filesystem::is_regular_file(candidate) && ::access(candidate.c_str(), X_OK) == 0) return candidate;
        rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
    return {};
}

}   // namespace meshfolio::cli
