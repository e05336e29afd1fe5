#include "base/file_bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/linux_only.h"
#include "base/nearest_word.h"

namespace meshfolio {

namespace {

std::string reason() { return std::strerror(errno); }

/// Reads until `room` is full or the input ends. Returns the number of bytes read.
std::size_t read_from(int descriptor, std::span<char> room, const Location& where) {
    std::size_t have = 0;
    while (have < room.size()) {
        const ssize_t got = ::read(descriptor, room.data() + have, room.size() - have);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(where, "cannot read the file (" + reason() + ")");
        if (got == 0) break;
        have += static_cast<std::size_t>(got);
    }
    return have;
}

/// A regular file, open for reading.
class RegularFile {
public:
    /// @throws InputError if the file cannot be opened or is not regular
    explicit RegularFile(const std::filesystem::path& path) : RegularFile(Location{path.string(), 0}) {
        struct stat status {};
        if (::fstat(descriptor_, &status) != 0) throw InputError(where, "cannot examine the file (" + reason() + ")");
        if (S_ISDIR(status.st_mode)) throw InputError(where, "is a folder, not a file", "name a file in it");
        if (!S_ISREG(status.st_mode))
            throw InputError(where, "is not a regular file", "pipes and devices are not read; save what they give as a file");
        size = static_cast<std::uintmax_t>(status.st_size);
    }
    ~RegularFile() { ::close(descriptor_); }
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    std::size_t read(std::span<char> room) { return read_from(descriptor_, room, where); }

    const Location where;
    std::uintmax_t size = 0;

private:
    /// Only opens. O_NONBLOCK: opening a FIFO without a writer must not hang.
    explicit RegularFile(Location place)
        : where(std::move(place)), descriptor_(::open(where.file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        if (descriptor_ >= 0) return;
        const std::string why = reason(), meant = near_names(where.file);
        throw InputError(where, "cannot open the file (" + why + ")", meant.empty() ? "check its name and the right to read it" : meant);
    }

    int descriptor_;
};

}   // namespace

std::string near_names(const std::filesystem::path& missing) {
    namespace fs = std::filesystem;
    constexpr std::size_t most = 10000;                                               // names looked at
    const fs::path path = missing.has_filename() ? missing : missing.parent_path();   // "meshes/"
    if (may_be_there(path)) return "";
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator it(path.has_parent_path() ? path.parent_path() : fs::path("."), error);
    for (; !error && it != fs::directory_iterator() && names.size() < most; it.increment(error))
        names.push_back(it->path().filename().string());
    std::string words = suggestion(path.filename().string(), names);
    if (!words.empty()) words.pop_back();   // the space at its end
    return words;
}

bool may_be_there(const std::filesystem::path& path) {
    std::error_code unknown;
    return std::filesystem::symlink_status(path, unknown).type() != std::filesystem::file_type::not_found;
}

std::string read_file(const std::filesystem::path& path, std::uintmax_t limit) {
    RegularFile file(path);
    const std::string size = std::to_string(file.size) + " bytes";
    if (file.size > limit)
        throw InputError(file.where, "the file has " + size + ", more than the limit of " + std::to_string(limit), "make it smaller");
    std::string bytes;
    try {   // a file may claim any size
        bytes.reserve(file.size);
        prefer_large_pages(bytes.data(), file.size);
        bytes.resize(file.size);
    } catch (const std::bad_alloc&) {
        throw InputError(file.where, "out of memory for the " + size + " of the file", "use a smaller one");
    }
    bytes.resize(file.read(bytes));
    return bytes;
}

std::string read_standard_input(const std::string& name) {
    const Location where{name, 0};
    std::string bytes;
    std::size_t have = 0;
    while (have == bytes.size()) {   // the room is full
        if (have > largest_file) throw InputError(where, "more than " + std::to_string(largest_file) + " bytes", "make it smaller");
        bytes.resize(2 * have + 65536);
        have += read_from(STDIN_FILENO, std::span(bytes).subspan(have), where);
    }
    bytes.resize(have);
    return bytes;
}

void read_in_pieces(const std::filesystem::path& path, const std::function<void(std::string_view)>& take) {
    RegularFile file(path);
    std::string piece(std::size_t{1} << 16, '\0');
    for (std::size_t have = file.read(piece); have > 0; have = file.read(piece)) take(std::string_view(piece).substr(0, have));
}

void write_all(int descriptor, std::string_view bytes, const std::string& name) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0 && errno == EAGAIN) {   // a terminal or a pipe that another program set to non-blocking
            pollfd ready{descriptor, POLLOUT, 0};
            ::poll(&ready, 1, -1);
            continue;
        }
        if (put < 0 && errno == EPIPE) throw ReaderGone(name, "cannot write (" + reason() + ")");
        if (put < 0) throw OutputError(name, "cannot write (" + reason() + ")");
        if (put == 0) throw OutputError(name, "cannot write (the system accepted no bytes)");
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
}

NewFile::NewFile(std::filesystem::path path, std::filesystem::perms permissions) : path_(std::move(path)) {
    struct stat there {};
    const bool has_other_links = ::lstat(path_.c_str(), &there) == 0 && S_ISREG(there.st_mode) && there.st_nlink > 1;
    if (has_other_links && ::unlink(path_.c_str()) != 0) throw OutputError(path_.string(), "cannot be replaced (" + reason() + ")");
    descriptor_ =
        ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, static_cast<mode_t>(permissions & std::filesystem::perms::all));
    if (descriptor_ < 0) throw OutputError(path_.string(), "cannot create the file (" + reason() + ")");
}

NewFile::~NewFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void NewFile::finish(std::string_view bytes, bool synced) {
    write_all(descriptor_, bytes, path_.string());
    // /dev/null and /dev/stdout refuse fsync, which is not a failed write.
    if (synced && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
        throw OutputError(path_.string(), "cannot flush to disk (" + reason() + ")");
    if (::close(std::exchange(descriptor_, -1)) != 0)   // delayed write errors arrive here
        throw OutputError(path_.string(), "cannot close the file (" + reason() + ")");
}

void write_file(const std::filesystem::path& path, std::string_view bytes) { NewFile(path).finish(bytes, true); }

}   // namespace meshfolio
