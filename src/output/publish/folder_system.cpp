#include "output/publish/folder_system.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/errors.h"
#include "base/lower_case.h"
#include "output/publish/temporaries.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

OpenFolder::OpenFolder(const fs::path& path) : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0)
        throw OutputError(path.string(), std::string("cannot open the folder (") + std::strerror(errno) + ")", "check its path and rights");
}

OpenFolder::~OpenFolder() { ::close(descriptor_); }

void OpenFolder::sync() const {
    // Some network and overlay file systems know no fsync of folders.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
        throw OutputError(path_.string(), std::string("cannot flush the folder to disk (") + std::strerror(errno) + ")", "check the disk");
}

void OpenFolder::lock() const {
    if (!try_lock()) throw OutputError(path_.string(), "is busy: another run is writing there", "wait for its end");
}

bool OpenFolder::try_lock() const { return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

bool OpenFolder::is_in_its_place() const {
    struct stat open {};
    struct stat named {};
    return ::fstat(descriptor_, &open) == 0 && ::lstat(path_.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
           open.st_ino == named.st_ino;
}

fs::path resolved(const fs::path& path, std::error_code& error) {
    fs::path target = fs::absolute(path, error);
    // Twice: after "nowhere/.." the first call only shortens the path and follows no links.
    for (int i = 0; i < 2 && !error; ++i) target = fs::weakly_canonical(target, error);
    return target;
}

fs::path path_inside(const fs::path& path, const fs::path& folder) {
    std::error_code error;
    const fs::path whole = resolved(path, error), outer = error ? fs::path() : resolved(folder, error);
    const fs::path inside = error ? fs::path() : whole.lexically_relative(outer);
    return inside.empty() || *inside.begin() == ".." ? fs::path() : inside;
}

void require_folder(const fs::path& path) {
    std::error_code error;
    fs::path there = resolved(path, error);
    if (error)
        throw OutputError(path.string(), "cannot create the folder (" + error.message() + ")", "choose another path, or check the rights");
    while (!fs::exists(fs::symlink_status(there, error)) && there.has_relative_path()) there = there.parent_path();
    if (!fs::is_directory(there, error))
        throw OutputError(path.string(), "cannot be a folder: " + there.string() + " is none", "choose another name");
    if (::access(there.c_str(), W_OK | X_OK) != 0)
        throw OutputError(path.string(), std::string("takes no files (") + std::strerror(errno) + ")", "choose another folder");
}

fs::path place_of_file(const fs::path& path) {
    if (is_stream(path)) return path;   // a link to a pipe has no path to follow
    std::error_code error;
    const fs::path target = resolved(path, error), folder = target.parent_path();
    if (error) throw OutputError(path.string(), "cannot be a file (" + error.message() + ")", "choose another name");
    if (fs::is_directory(target, error))
        throw OutputError(path.string(), std::string("cannot be a file (") + std::strerror(EISDIR) + ")", "choose another name");
    if (!fs::is_directory(folder, error)) throw OutputError(path.string(), "its folder does not exist", "create it first");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw OutputError(path.string(), std::string("its folder takes no files (") + std::strerror(errno) + ")", "choose another one");
    return target;
}

bool is_stream(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void make_folder(const fs::path& path) {
    const auto permission = permission_to_create();
    std::error_code error;
    fs::create_directories(path, error);
    if (error)
        throw OutputError(path.string(), "cannot create the folder (" + error.message() + ")", "choose another path, or check the rights");
}

bool is_safe_name(std::string_view name) {
    const auto safe = [](char c) { return is_alphanumeric(c) || c == '_' || c == '.' || c == '+' || c == '-'; };
    return !name.empty() && name.size() <= 120 && name.front() != '.' && name.front() != '-' && std::all_of(name.begin(), name.end(), safe);
}

}   // namespace meshfolio::output
