#include "output/publish/temporaries.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <fstream>

#include <atomic>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "output/publish/folder_marks.h"
#include "output/publish/user_files.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

struct Registry {
    std::recursive_mutex creating;   // permission_to_create()
    bool has_published = false;      // guarded by `creating`
    std::mutex listing;              // guards `paths`
    std::set<fs::path> paths;
    std::atomic<char*> reserve = new char[std::size_t{1} << 20];   // freed when removal runs out of memory
};

/// Returns the registry of this process. It is never destroyed: a signal may come while the program ends.
Registry& registry() {
    static auto* const instance = new Registry;
    return *instance;
}

/// Empties a folder except for its marker, the sums last: after an interrupted removal the next run still recognises the folder and files.
void remove_contents(const fs::path& folder, std::error_code& error) {
    if (fs::is_symlink(fs::symlink_status(folder, error)) || !fs::is_directory(folder, error)) return;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const fs::path name = it->path().filename();
        if (name != report_folder.marker && name != marks_folder.marker && name != sums_file) fs::remove_all(it->path(), error);
    }
    if (!error) fs::remove(folder / sums_file, error);
}

/// Gives the owner all rights on a folder and the folders below it: the user's own may be closed.
void open_folders(const fs::path& folder) {
    std::error_code error;
    const auto open = [&](const fs::path& one) { fs::permissions(one, fs::perms::owner_all, fs::perm_options::add, error); };
    if (!fs::is_directory(fs::symlink_status(folder, error))) return;
    open(folder);
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (fs::is_directory(it->symlink_status())) open(it->path());
}

/// Removes a path with everything in it. Tries repeatedly, because a thread that still writes may add files meanwhile.
/// @return true if nothing is left
bool remove_stubbornly(const fs::path& path) noexcept {
    for (int attempt = 0; attempt < 100; ++attempt) {
        std::error_code error;
        try {
            if (attempt == 1) open_folders(path);
            remove_contents(path, error);
            fs::remove_all(path, error);
        } catch (const std::exception&) {
            error = std::make_error_code(std::errc::not_enough_memory);
        }
        if (!error) return true;
        if (error == std::errc::not_enough_memory) delete[] registry().reserve.exchange(nullptr);
        ::usleep(1000);
    }
    return false;
}

}   // namespace

Temporary::Temporary(fs::path path) : path_(std::move(path)) {
    const std::lock_guard lock(registry().listing);
    registry().paths.insert(path_);
}

Temporary::~Temporary() {
    if (!is_kept_) remove_stubbornly(path_);
    const std::lock_guard lock(registry().listing);
    registry().paths.erase(path_);
}

bool Temporary::remove() const noexcept { return remove_stubbornly(path_); }

void Temporary::keep() noexcept {
    is_kept_ = true;
    const std::lock_guard lock(registry().listing);
    registry().paths.erase(path_);
}

std::unique_lock<std::recursive_mutex> permission_to_create() { return std::unique_lock(registry().creating); }

void remember_publication() { registry().has_published = true; }

void write_part(const Temporary& part, std::string_view bytes, bool synced, std::filesystem::perms permissions) {
    auto permission = permission_to_create();
    NewFile file(part.path(), permissions);
    permission.unlock();   // a file that has lost its name may still be written
    file.finish(bytes, synced);
}

bool abandon_publications() noexcept {
    registry().creating.lock();   // and never unlocked
    registry().listing.lock();
    for (const auto& path : registry().paths) remove_stubbornly(path);
    return registry().has_published;
}

std::string process_number() { return std::to_string(::getpid()); }

namespace {

/// True for a folder that this program made: it has a marker, or holds a .gitignore at most.
bool is_our_folder(const fs::directory_entry& entry) {
    if (entry.is_symlink() || !entry.is_directory()) return false;
    if (is_marked(entry.path())) return true;
    return std::all_of(fs::directory_iterator(entry.path()), fs::directory_iterator(),
                       [](const fs::directory_entry& inside) { return inside.path().filename() == ".gitignore"; });
}

/// Calls use(entry) for each entry of `folder` that a dead process left under the name `<stem><pid>…`.
/// @param own  also entries with the number of this process, which an earlier process may have had
template <class Use> void for_each_leftover(const fs::path& folder, const std::string& stem, bool own, const Use& use) noexcept try {
    std::vector<fs::directory_entry> entries;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) entries.push_back(*it);
    for (const fs::directory_entry& entry : entries) {
        const long pid = process_in_name(entry.path().filename().string(), stem);
        if (pid > 0 && (pid == ::getpid() ? own : is_dead(pid))) use(entry);
    }
} catch (const std::exception&) {
    // A leftover that cannot be examined stays.
}

}   // namespace

bool is_dead(long pid) {
    if (::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH) return true;
    // Killed, but not yet collected: the state after the name in parentheses is Z. (Files of /proc have no size, so no read_file.)
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
    std::error_code ignored;
    const auto remove = [&](const fs::directory_entry& entry) {
        if (is_our_folder(entry)) remove_stubbornly(entry.path());
    };
    const auto settle = [&](const fs::directory_entry& entry, bool was_there) {
        if (!is_our_folder(entry)) return;
        const bool is_finished = may_be_there(entry.path() / sums_file);   // written last, in one step
        if ((was_there || is_finished) && !may_be_there(target)) return fs::rename(entry.path(), target, ignored);
        if (is_finished) {
            UserFiles users(entry.path());
            users.examine();
            if (users.any() && !is_marked(target)) return;   // the user's files have no place to go
            users.move_into(target);
        }
        remove_stubbornly(entry.path());
    };
    const std::string name = target.filename().string();
    for_each_leftover(target.parent_path(), name + ".old-", true, [&](const auto& entry) { settle(entry, true); });
    for_each_leftover(target.parent_path(), name + ".tmp-", true, [&](const auto& entry) { settle(entry, false); });
    for_each_leftover(target, ".meshfolio.tmp-", true, remove);   // of runs into a mount point
} catch (const std::exception&) {
    // Leftovers that cannot be handled stay for the next run.
}

void sweep_file_leftovers(const fs::path& folder) noexcept {
    // Files with the number of this process stay: another thread may be writing one.
    for_each_leftover(folder, ".meshfolio.part-", false, [](const fs::directory_entry& entry) {
        std::error_code ignored;
        if (entry.is_regular_file() && !entry.is_symlink()) fs::remove(entry.path(), ignored);
    });
}

void sweep_scratch_leftovers(const fs::path& place, const std::string& stem) noexcept {
    for_each_leftover(place, stem, false, [](const fs::directory_entry& entry) {
        std::error_code ignored;
        struct stat status {};
        if (::lstat(entry.path().c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid())
            fs::remove_all(entry.path(), ignored);
    });
}

}   // namespace meshfolio::output
