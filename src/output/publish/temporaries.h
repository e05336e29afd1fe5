/// @file
/// The temporary files and folders of this process, so that a signal can have them removed at any moment,
/// and those that earlier processes left.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "base/file_bytes.h"

namespace meshfolio::output {

/// A path that is removed with everything in it when this goes, or earlier by remove_all_temporaries().
class Temporary {
public:
    explicit Temporary(std::filesystem::path path);
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const std::filesystem::path& path() const { return path_; }
    /// @return whether nothing is left of it
    bool remove() const noexcept;
    /// Leaves it where it is, for a later run.
    void keep() noexcept;
    bool is_kept() const { return is_kept_; }

private:
    std::filesystem::path path_;
    bool is_kept_ = false;
};

/// A recursive lock, held while a file is created or renamed. After remove_all_temporaries() it is never granted again.
std::unique_lock<std::recursive_mutex> permission_to_create();
/// Call it with the lock once something is published.
void remember_publication();

/// Writes the file at `part`. @param synced  returns only when the bytes are on the disk @throws OutputError
void write_part(const Temporary& part, std::string_view bytes, bool synced, std::filesystem::perms permissions = new_file_permissions);

/// Takes the lock for good and removes all registered paths, even while other threads write there.
/// @return whether something was published before
bool remove_all_temporaries() noexcept;

/// The number of this process, which ends the names of temporary files.
std::string process_number();

/// True when no process has this number (any more), or one that was killed and only waits to be collected.
bool is_dead(long pid);

/// The process number at the end of `name` when it reads `<stem><digits>`; else 0.
long process_in_name(const std::string& name, const std::string& stem);

/// Cleans up what interrupted runs left beside `target`, as `<target>.tmp-<pid>` or `<target>.old-<pid>`. A finished folder becomes
/// `target` where that is missing; otherwise the user's files in it are moved into `target`, and it is removed as an unfinished one is.
/// Folders without our mark and anything else are left alone, and nothing that cannot be removed is an error.
void sweep_leftovers(const std::filesystem::path& target) noexcept;

/// The same for the temporary files of a FileGroup in `folder`.
void sweep_file_leftovers(const std::filesystem::path& folder) noexcept;

/// And for folders `<stem><pid>-…` of this user in `place`, which others may use as well.
void sweep_scratch_leftovers(const std::filesystem::path& place, const std::string& stem) noexcept;

}   // namespace meshfolio::output
