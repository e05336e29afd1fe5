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
#include "base/large_pages.h"
#include "base/nearest_word.h"

namespace meshfolio {

namespace {

std::string reason() { return std::strerror(errno); }

/// Closes on every way out.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    int get() const { return fd_; }

private:
    int fd_;
};

/// A string of `size` bytes. @throws InputError where they do not fit into memory: a file may claim any size
std::string room_for(std::uintmax_t size, const Location& where) try {
    std::string bytes;
    bytes.reserve(size);
    prefer_large_pages(bytes.data(), size);
    bytes.resize(size);
    return bytes;
} catch (const std::bad_alloc&) {
    throw InputError(where, "out of memory for the " + std::to_string(size) + " bytes of the file", "use a smaller one");
}

/// The next bytes, as many as there is room for; fewer only at the end. @return how many
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

/// Whatever is no regular file is refused. O_NONBLOCK: opening a FIFO that nobody writes to must not hang.
class RegularFile {
public:
    explicit RegularFile(const Location& where) : where_(where), file_(::open(where.file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        if (file_.get() < 0) {
            const std::string why = reason(), meant = near_names(where.file);
            throw InputError(where, "cannot open the file (" + why + ")",
                             meant.empty() ? "check its name and the right to read it" : meant);
        }
        struct stat status {};
        if (::fstat(file_.get(), &status) != 0) throw InputError(where, "cannot examine the file (" + reason() + ")");
        if (S_ISDIR(status.st_mode)) throw InputError(where, "is a folder, not a file", "name a file in it");
        if (!S_ISREG(status.st_mode))
            throw InputError(where, "is not a regular file", "pipes and devices are not read; save what they give as a file");
        size_ = static_cast<std::uintmax_t>(status.st_size);
    }
    std::uintmax_t size() const { return size_; }

    std::size_t read(std::span<char> room) { return read_from(file_.get(), room, where_); }

private:
    Location where_;
    Descriptor file_;
    std::uintmax_t size_ = 0;
};

}   // namespace

std::string near_names(const std::filesystem::path& missing) {
    namespace fs = std::filesystem;
    constexpr std::size_t most = 10000;                                               // looked at
    const fs::path path = missing.has_filename() ? missing : missing.parent_path();   // "meshes/"
    if (may_be_there(path)) return "";
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator it(path.has_parent_path() ? path.parent_path() : fs::path("."), error);
    for (; !error && it != fs::directory_iterator() && names.size() < most; it.increment(error))
        names.push_back(it->path().filename().string());
    std::string words;
    for (const std::string& name : near_words(path.filename().string(), std::move(names)))
        words += (words.empty() ? "did you mean '" : " or '") + name + "'";
    return words.empty() ? words : words + "?";
}

bool may_be_there(const std::filesystem::path& path) {
    std::error_code unknown;
    return std::filesystem::symlink_status(path, unknown).type() != std::filesystem::file_type::not_found;
}

std::string read_file(const std::filesystem::path& path, std::uintmax_t limit) {
    const Location where{path.string(), 0};
    RegularFile file(where);
    if (file.size() > limit) {
        throw InputError(where, "the file has " + std::to_string(file.size()) + " bytes, more than the limit of " + std::to_string(limit),
                         "make it smaller");
    }
    std::string bytes = room_for(file.size(), where);
    bytes.resize(file.read(bytes));
    return bytes;
}

std::string read_standard_input(const std::string& name) {
    const Location where{name, 0};
    std::string bytes;
    std::size_t have = 0;
    while (have == bytes.size()) {   // all room was filled
        if (have > largest_file) throw InputError(where, "more than " + std::to_string(largest_file) + " bytes", "make it smaller");
        bytes.resize(2 * have + 65536);
        have += read_from(STDIN_FILENO, std::span(bytes).subspan(have), where);
    }
    bytes.resize(have);
    return bytes;
}

void read_in_pieces(const std::filesystem::path& path, const std::function<void(std::string_view)>& take) {
    RegularFile file({path.string(), 0});
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
        if (put == 0) throw OutputError(name, "cannot write (nothing was taken)");
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
    // /dev/null and /dev/stdout know no fsync; that is not a failed write.
    if (synced && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
        throw OutputError(path_.string(), "cannot flush to disk (" + reason() + ")");
    if (::close(std::exchange(descriptor_, -1)) != 0)   // delayed write errors arrive here
        throw OutputError(path_.string(), "cannot close the file (" + reason() + ")");
}

void write_file(const std::filesystem::path& path, std::string_view bytes) { NewFile(path).finish(bytes, true); }

}   // namespace meshfolio
