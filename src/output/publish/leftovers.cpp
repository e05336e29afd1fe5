#include "output/publish/leftovers.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <vector>

#include "base/number_text.h"
#include "output/publish/publish.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

/// Only a folder that carries our marker, or never held more than a .gitignore, is ours to remove.
bool is_our_folder(const fs::directory_entry& entry) {
    if (entry.is_symlink() || !entry.is_directory()) return false;
    if (fs::exists(entry.path() / marker_file)) return true;
    return std::all_of(fs::directory_iterator(entry.path()), fs::directory_iterator(),
                       [](const fs::directory_entry& inside) { return inside.path().filename() == ".gitignore"; });
}

/// Of a process that has ended, or of one that had our number before us.
bool is_leftover_of(const std::string& name, const std::string& stem) {
    const long pid = process_in_name(name, stem);
    return pid > 0 && (is_dead(pid) || pid == ::getpid());
}

std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
    std::vector<fs::directory_entry> entries;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) entries.push_back(*it);
    return entries;
}

}   // namespace

bool is_dead(long pid) {
    if (::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH) return true;
    // Killed, but not yet waited for: the state after the name in parentheses is Z. (Files of /proc have no size to read by.)
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string status;
    std::getline(file, status);
    const std::size_t name_end = status.rfind(") ");
    return name_end != std::string::npos && name_end + 2 < status.size() && (status[name_end + 2] == 'Z' || status[name_end + 2] == 'X');
}

long process_in_name(const std::string& name, const std::string& stem) {
    if (!name.starts_with(stem)) return 0;
    const std::string digits = name.substr(stem.size(), name.find_first_not_of("0123456789", stem.size()) - stem.size());
    const auto pid = parse_integer(digits);
    return pid && *pid < (1L << 31) ? static_cast<long>(*pid) : 0;
}

void sweep_leftovers(const fs::path& target) noexcept try {
    const std::string name = target.filename().string();
    for (const fs::directory_entry& entry : entries_of(target.parent_path())) {
        const std::string found = entry.path().filename().string();
        const bool unfinished = is_leftover_of(found, name + ".tmp-"), replaced = is_leftover_of(found, name + ".old-");
        if (!(unfinished || replaced) || !is_our_folder(entry)) continue;
        std::error_code ignored;
        if (replaced && !fs::exists(target)) {
            fs::rename(entry.path(), target, ignored);
        } else {
            fs::remove_all(entry.path(), ignored);
        }
    }
    for (const fs::directory_entry& entry : entries_of(target)) {   // of runs into a mount point
        std::error_code ignored;
        if (is_leftover_of(entry.path().filename().string(), ".meshfolio.tmp-") && is_our_folder(entry))
            fs::remove_all(entry.path(), ignored);
    }
} catch (const std::exception&) {
    // A leftover that cannot be examined stays; the run itself is not in danger.
}

void sweep_file_leftovers(const fs::path& folder) noexcept try {
    for (const fs::directory_entry& entry : entries_of(folder)) {
        std::error_code ignored;
        // Not those with our own number: another thread may be writing one.
        const long pid = process_in_name(entry.path().filename().string(), ".meshfolio.part-");
        if (pid > 0 && is_dead(pid) && entry.is_regular_file() && !entry.is_symlink()) fs::remove(entry.path(), ignored);
    }
} catch (const std::exception&) {
    // As above.
}

void sweep_scratch_leftovers(const fs::path& place, const std::string& stem) noexcept try {
    for (const fs::directory_entry& entry : entries_of(place)) {
        const long pid = process_in_name(entry.path().filename().string(), stem);
        struct stat status {};
        if (pid == 0 || !is_dead(pid) || ::lstat(entry.path().c_str(), &status) != 0) continue;
        std::error_code ignored;
        if (S_ISDIR(status.st_mode) && status.st_uid == ::geteuid()) fs::remove_all(entry.path(), ignored);
    }
} catch (const std::exception&) {
    // As above.
}

}   // namespace meshfolio::output
