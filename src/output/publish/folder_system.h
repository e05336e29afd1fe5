/// @file
/// Checked system calls on folders that the standard library does not offer. Renaming: base/linux_only.h.
#pragma once

#include <filesystem>
#include <string_view>

namespace meshfolio::output {

/// An open folder.
class OpenFolder {
public:
    explicit OpenFolder(const std::filesystem::path& path);   // throws OutputError
    ~OpenFolder();
    OpenFolder(const OpenFolder&) = delete;
    OpenFolder& operator=(const OpenFolder&) = delete;
    /// Flushes changed names in the folder to the disk. @throws OutputError
    void sync() const;
    /// Locks the folder until this object or the process ends; does nothing on file systems without locks.
    /// @throws OutputError if another process has the lock
    void lock() const;
    /// Locks the folder like lock(); returns false, instead of throwing, if another process has the lock.
    bool try_lock() const;
    /// True if the path still names this folder.
    bool is_in_its_place() const;

private:
    std::filesystem::path path_;
    int descriptor_;
};

/// Returns the absolute path, with links followed as far as it exists. @param error  set if there is none
std::filesystem::path resolved(const std::filesystem::path& path, std::error_code& error);

/// Returns `path` relative to `folder`, with links followed; empty if it is not inside.
std::filesystem::path path_inside(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Returns the path that a file of this name will have, with links followed.
/// @throws OutputError if it cannot be made: its folder is missing or not writable, or it is a folder itself
std::filesystem::path place_of_file(const std::filesystem::path& path);

/// True for a device, a pipe or a socket, which a rename cannot replace.
bool is_stream(const std::filesystem::path& path);

/// Requires that make_folder() can make the folder and that it is writable. @throws OutputError otherwise
void require_folder(const std::filesystem::path& path);

/// Creates the folder and its parents, if missing. @throws OutputError
void make_folder(const std::filesystem::path& path);

/// True for a plain file name: 1 to 120 characters of [A-Za-z0-9_.+-] that do not begin with '.' or '-'.
bool is_safe_name(std::string_view name);

}   // namespace meshfolio::output
