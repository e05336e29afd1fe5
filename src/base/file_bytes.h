/// @file
/// Whole files in and out, every system call checked. stdio and iostreams are not used for output because they
/// swallow ENOSPC and EIO.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace meshfolio {

/// Is anything there of that name, whether or not it can be read? Links that lead nowhere and folders that are closed count: reading them
/// reports what is wrong.
bool may_be_there(const std::filesystem::path& path);

/// "did you mean 'bunny.obj' or 'bunny.off'?", of what its folder has, where there is nothing of that name; else empty.
std::string near_names(const std::filesystem::path& missing);

inline constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 30;   // bytes

/// The bytes of a regular file.
/// @throws InputError if it is missing, unreadable, not a regular file, or larger than `limit` bytes
std::string read_file(const std::filesystem::path& path, std::uintmax_t limit = largest_file);

/// All that standard input gives, whatever it is. @throws InputError if it is closed or gives more than largest_file
std::string read_standard_input(const std::string& name);

/// The same bytes piece by piece, for whom not all of them must be in memory at once. @throws InputError as above
void read_in_pieces(const std::filesystem::path& path, const std::function<void(std::string_view)>& take);

/// Of a file that is created, before the umask.
inline constexpr std::filesystem::perms new_file_permissions{0666};

/// Creates or replaces `path` with `bytes`; the data has reached the disk when this returns. A file that has other links as well is
/// replaced by a new one, so that what they name stays as it was.
/// @throws OutputError naming the path and the system's reason
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The same in two steps, for whoever must know when the name appears.
class NewFile {
public:
    /// Creates or empties the file. @throws OutputError
    explicit NewFile(std::filesystem::path path, std::filesystem::perms permissions = new_file_permissions);
    ~NewFile();
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    /// Once. @param synced  not for what may be lost with the power @throws OutputError
    void finish(std::string_view bytes, bool synced);

private:
    std::filesystem::path path_;
    int descriptor_;
};

/// Writes to an open descriptor (1: standard output) until all is taken.
/// @throws OutputError as above, ReaderGone for a pipe; `name` is what the message calls the target
void write_all(int descriptor, std::string_view bytes, const std::string& name);

}   // namespace meshfolio
