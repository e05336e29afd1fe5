/// @file
/// The system calls on folders that the standard library does not offer, each checked. Renaming: base/linux_only.h.
#pragma once

#include <filesystem>
#include <string_view>

namespace meshfolio::output {

/// An open folder, to be synced after names in it have changed.
class OpenFolder {
public:
    /// @throws OutputError
    explicit OpenFolder(const std::filesystem::path& path);
    ~OpenFolder();
    OpenFolder(const OpenFolder&) = delete;
    OpenFolder& operator=(const OpenFolder&) = delete;
    /// @throws OutputError
    void sync() const;
    /// Until this goes, however the process ends. File systems without locks let everyone in. @throws OutputError if another has it
    void lock() const;
    /// The same without an error. @return whether it has the lock
    bool try_lock() const;
    /// Returns whether its name still stands for this folder.
    bool is_in_its_place() const;

private:
    std::filesystem::path path_;
    int descriptor_;
};

/// The absolute path, links followed as far as it exists, which a rename needs. @param error  why there is none
std::filesystem::path resolved(const std::filesystem::path& path, std::error_code& error);

/// `path` relative to `folder`, links followed; empty if it is not inside.
std::filesystem::path path_inside(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Where a file of that name will stand, links followed. @throws OutputError where none can be made or replaced: its folder is missing or
/// closed, or it is a folder itself
std::filesystem::path place_of_file(const std::filesystem::path& path);

/// Is there a device, a pipe or the like, which cannot be replaced by a rename?
bool is_stream(const std::filesystem::path& path);

/// Before the work: can make_folder() make it, and files be put into it? @throws OutputError
void require_folder(const std::filesystem::path& path);

/// mkdir, parents too. @throws OutputError
void make_folder(const std::filesystem::path& path);

/// True for a plain file name: 1 to 120 characters of [A-Za-z0-9_.+-], the first of which is no point and no minus.
bool is_safe_name(std::string_view name);

}   // namespace meshfolio::output
