/// @file
/// The temporary files and folders of this process, which can be removed at any moment, and those that earlier processes left.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "base/file_bytes.h"

namespace meshfolio::output {

/// A path that is removed with everything in it by the destructor, or earlier by abandon_publications().
class Temporary {
public:
    explicit Temporary(std::filesystem::path path);
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const std::filesystem::path& path() const { return path_; }
    /// Removes the path now. Returns true if nothing of it is left.
    bool remove() const noexcept;
    /// Makes the destructor leave the path, which a later run sweeps.
    void keep() noexcept;
    bool is_kept() const { return is_kept_; }

private:
    std::filesystem::path path_;
    bool is_kept_ = false;
};

/// Returns a recursive lock, to be held while a file is created or renamed. After abandon_publications() this function never returns.
std::unique_lock<std::recursive_mutex> permission_to_create();
/// Makes abandon_publications() return true. To be called with the lock of permission_to_create().
void remember_publication();

/// Writes the file at `part`. @param synced  return only when the bytes are on the disk @throws OutputError
void write_part(const Temporary& part, std::string_view bytes, bool synced, std::filesystem::perms permissions = new_file_permissions);

/// For an early end of the process, such as a signal: removes every temporary file and folder of this process, even while other threads
/// write there, and lets nothing more be published. Returns true if something was published before.
bool abandon_publications() noexcept;

/// Returns the number of this process as text, for the names of temporary files.
std::string process_number();

/// True if no process has this number, or only a killed one that its parent has not collected yet.
bool is_dead(long pid);

/// Returns the process number in a name of the form `<stem><digits>…`; 0 for other names.
long process_in_name(const std::string& name, const std::string& stem);

/// Removes the folders `<target>.tmp-<pid>` and `<target>.old-<pid>` of interrupted runs. If `target` is missing, a finished folder becomes
/// `target`; otherwise the user's files in it are moved into `target` first. Folders without a marker stay; failures are ignored.
void sweep_leftovers(const std::filesystem::path& target) noexcept;

/// Removes the temporary files that FileGroups of dead processes left in `folder`. Failures are ignored.
void sweep_file_leftovers(const std::filesystem::path& folder) noexcept;

/// Removes the folders `<stem><pid>-…` of this user's dead processes in `place`, a folder such as /tmp. Failures are ignored.
void sweep_scratch_leftovers(const std::filesystem::path& place, const std::string& stem) noexcept;

}   // namespace meshfolio::output
