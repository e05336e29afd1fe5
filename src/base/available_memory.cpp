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

/// The number behind `name` in a table of names and numbers; an empty name: the first of the file. None for "max".
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

class Least {
public:
    void take(std::optional<double> bytes, const char* limit) {
        if (bytes && (least.limited_by.empty() || *bytes < least.bytes)) least = {std::max(*bytes, 1.0), limit};
    }
    AvailableMemory least;
};

/// What is left in the group of `folder` and in those above it, up to `top`: pages of files that can be dropped count as free.
void take_groups(Least& least, const fs::path& top, const fs::path& group, const char* limit, const char* usage, const char* droppable) {
    for (fs::path folder = top / group.relative_path();; folder = folder.parent_path()) {
        const auto most = number_in(folder / limit, ""), used = number_in(folder / usage, "");
        if (most && used) least.take(*most - *used + number_in(folder / "memory.stat", droppable).value_or(0), "the control group");
        if (folder == top || !folder.has_relative_path()) return;
    }
}

}   // namespace

AvailableMemory available_memory(const fs::path& root) {
    Least least;
    if (const auto kilobytes = number_in(root / "proc/meminfo", "MemAvailable:")) least.take(1024 * *kilobytes, "MemAvailable");
    rlimit limit{};
    const auto pages = number_in(root / "proc/self/statm", "");
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && pages)
        least.take(static_cast<double>(limit.rlim_cur) - *pages * static_cast<double>(::sysconf(_SC_PAGESIZE)), "RLIMIT_AS");
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {   // "0::/user.slice", "7:memory:/docker/ab"
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
        if (controllers == ",,")
            take_groups(least, root / "sys/fs/cgroup", group, "memory.max", "memory.current", "inactive_file ");
        else if (controllers.find(",memory,") != std::string::npos)
            take_groups(least, root / "sys/fs/cgroup/memory", group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                        "total_inactive_file ");
    }
    return least.least;
}

}   // namespace meshfolio
