#include "output/publish/temporaries.h"

#include <unistd.h>

#include <atomic>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "base/file_bytes.h"
#include "output/publish/publish.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

struct Registry {
    std::recursive_mutex creating;   // the permission
    bool has_published = false;      // guarded by it
    std::mutex listing;              // guards `paths`
    std::set<fs::path> paths;
    std::atomic<char*> reserve = new char[std::size_t{1} << 20];   // given back when there is no memory left to remove anything
};

/// Never destroyed: a signal may come while the program ends.
Registry& registry() {
    static auto* const instance = new Registry;
    return *instance;
}

/// The marker goes last: a removal that is cut short leaves a folder the next run still knows as ours.
void remove_contents(const fs::path& folder, std::error_code& error) {
    if (fs::is_symlink(fs::symlink_status(folder, error)) || !fs::is_directory(folder, error)) return;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (it->path().filename() != marker_file) fs::remove_all(it->path(), error);
    }
}

/// Repeated, because a writer that is still running may add a file between the listing and the removal of its folder.
/// @return whether nothing is left
bool remove_stubbornly(const fs::path& path) noexcept {
    for (int attempt = 0; attempt < 100; ++attempt) {
        std::error_code error;
        try {
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
    remove_stubbornly(path_);
    const std::lock_guard lock(registry().listing);
    registry().paths.erase(path_);
}

bool Temporary::remove() const noexcept { return remove_stubbornly(path_); }

std::unique_lock<std::recursive_mutex> permission_to_create() { return std::unique_lock(registry().creating); }

void remember_publication() { registry().has_published = true; }

void write_part(const Temporary& part, std::string_view bytes, bool synced, std::filesystem::perms permissions) {
    auto permission = permission_to_create();
    NewFile file(part.path(), permissions);
    permission.unlock();   // a file that has lost its name may still be written
    file.finish(bytes, synced);
}

bool remove_all_temporaries() noexcept {
    registry().creating.lock();   // and never unlocked
    registry().listing.lock();
    for (const auto& path : registry().paths) remove_stubbornly(path);
    return registry().has_published;
}

std::string process_number() { return std::to_string(::getpid()); }

}   // namespace meshfolio::output
