#include "base/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

namespace meshfolio {

namespace fs = std::filesystem;

namespace {

/// Returns the number after `name` in a table of names and numbers; for an empty name the first number. Nothing for "max".
std::optional<double> number_in(const fs::path& file, const std::string& name) {
    std::ifstream table(file);
    for (std::string line; std::getline(table, line);) {
        if (!line.starts_with(name)) continue;
        const char* text = line.c_str() + name.size();
        char* end = nullptr;
        const double value = std::strtod(text, &end);
        if (end != text) return value;
    }
    return {};
}

}   // namespace

AvailableMemory available_memory(const fs::path& root) {
    AvailableMemory least;
    const auto limit = [&](double bytes, const char* by) {
        if (least.limited_by.empty() || bytes < least.bytes) least = {std::max(bytes, 1.0), by};
    };
    if (const auto kilobytes = number_in(root / "proc/meminfo", "MemAvailable:")) limit(1024 * *kilobytes, "MemAvailable");
    rlimit addresses{};
    const auto pages = number_in(root / "proc/self/statm", "");
    if (::getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY && pages)
        limit(static_cast<double>(addresses.rlim_cur) - *pages * static_cast<double>(::sysconf(_SC_PAGESIZE)), "RLIMIT_AS");

    // Pages of files that can be dropped count as free.
    const auto limit_by_groups = [&](const fs::path& top, const fs::path& group, const char* most, const char* usage,
                                     const char* droppable) {
        for (fs::path folder = top / group.relative_path();; folder = folder.parent_path()) {
            const auto allowed = number_in(folder / most, ""), used = number_in(folder / usage, "");
            if (allowed && used) limit(*allowed - *used + number_in(folder / "memory.stat", droppable).value_or(0), "the control group");
            if (folder == top || !folder.has_relative_path()) return;
        }
    };
    const fs::path groups = root / "sys/fs/cgroup";
    std::ifstream table(root / "proc/self/cgroup");
    for (std::string line; std::getline(table, line);) {   // "0::/user.slice", "7:memory:/docker/ab"
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
        if (controllers == ",,") limit_by_groups(groups, group, "memory.max", "memory.current", "inactive_file ");
        else if (controllers.find(",memory,") != std::string::npos)
            limit_by_groups(groups / "memory", group, "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file ");
    }
    return least;
}

}   // namespace meshfolio
