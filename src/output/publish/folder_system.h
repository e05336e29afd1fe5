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

private:
    std::filesystem::path path_;
    int descriptor_;
};

/// Absolute, links followed as far as the path exists: what a rename will name. @param error  why there is no such path
std::filesystem::path resolved(const std::filesystem::path& path, std::error_code& error);

/// `path` as it lies in `folder`, links followed; empty where it does not lie there.
std::filesystem::path path_inside(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Where a file of that name will stand, links followed. @throws OutputError where none can be made or replaced: its folder is missing or
/// closed, or it is a folder itself
std::filesystem::path place_of_file(const std::filesystem::path& path);

/// What is there and takes bytes as they come: a device, a pipe.
bool is_stream(const std::filesystem::path& path);

/// Before the work: can make_folder() make it, and files be put into it? @throws OutputError
void require_folder(const std::filesystem::path& path);

/// mkdir, parents too. @throws OutputError
void make_folder(const std::filesystem::path& path);

/// True for a plain file name: 1 to 120 characters of [A-Za-z0-9_.+-], the first of which is no point and no minus.
bool is_safe_name(std::string_view name);

}   // namespace meshfolio::output
