/// @file
/// Whole files in and out, with every system call checked. Output does not use stdio or iostreams, which swallow ENOSPC and EIO.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace meshfolio {

/// False only if no file, folder or link has this path. Broken links and names in folders without access count as there: reading them
/// reports the problem.
bool may_be_there(const std::filesystem::path& path);

/// Returns "did you mean 'bunny.obj' or 'bunny.off'?" with up to three similar names from the folder of a missing file; "" if the file
/// exists or no name is similar.
std::string near_names(const std::filesystem::path& missing);

inline constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 30;   // bytes

/// Returns the bytes of a regular file. @throws InputError if it is missing, unreadable, not regular, or larger than `limit` bytes
std::string read_file(const std::filesystem::path& path, std::uintmax_t limit = largest_file);

/// Returns all bytes of standard input, which messages call `name`. @throws InputError if it is closed or exceeds `largest_file`
std::string read_standard_input(const std::string& name);

/// Hands the bytes of a regular file to `take` in pieces of at most 64 kB, in order. @throws InputError as read_file()
void read_in_pieces(const std::filesystem::path& path, const std::function<void(std::string_view)>& take);

/// Permissions of a new file, before the umask.
inline constexpr std::filesystem::perms new_file_permissions{0666};

/// Creates or replaces the file `path`; the bytes have reached the disk when this returns. A file that has other hard links is replaced by
/// a new one, so that its other names keep their contents. @throws OutputError with the path and the system's reason
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// write_file() in two steps: the name appears before the bytes.
class NewFile {
public:
    /// Creates or empties the file. @throws OutputError
    explicit NewFile(std::filesystem::path path, std::filesystem::perms permissions = new_file_permissions);
    ~NewFile();
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    /// Writes the bytes and closes the file; to be called once. @param synced  wait for the disk @throws OutputError
    void finish(std::string_view bytes, bool synced);

private:
    std::filesystem::path path_;
    int descriptor_;
};

/// Writes all bytes to an open descriptor (1: standard output), which messages call `name`.
/// @throws ReaderGone if the reader of a pipe has closed it, OutputError for other failures
void write_all(int descriptor, std::string_view bytes, const std::string& name);

}   // namespace meshfolio
