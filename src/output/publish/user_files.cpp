#include "output/publish/user_files.h"

#include <fcntl.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/joined.h"
#include "base/linux_only.h"
#include "base/sha256.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_marks.h"
#include "output/publish/temporaries.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

constexpr const char* remedy = "move it away, or choose another folder with --out";

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
    throw OutputError(path.string(), what + ", and meshfolio did not make it", remedy);
}

/// True for a folder, false for a link to one.
bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(fs::symlink_status(path, error));
}

/// Renames without replacing anything. @return 0 or errno
int move_to_free_name(const fs::path& from, const fs::path& to) {
    const int error = rename_with(from, to, Taken::kept);
    if (error != EINVAL && error != ENOSYS && error != EOPNOTSUPP) return error;
    return may_be_there(to) ? EEXIST : rename_with(from, to, Taken::replaced);
}

/// Returns the SHA-256 of a regular file; empty if it is no regular file or cannot be read.
std::string digest_of(const fs::path& file) try {
    return fs::is_regular_file(fs::symlink_status(file)) ? sha256_of_file(file) : "";
} catch (const std::exception&) {
    return "";
}

}   // namespace

std::string name_beside(const std::string& name, int number) {
    constexpr std::size_t longest = 235;   // bytes; a name has 255 at most
    if (number == 0) return name;
    return name.substr(0, longest) + ".edited" + (number > 1 ? "." + std::to_string(number) : "");
}

bool is_same_file(const fs::path& one, const fs::path& other) try {
    struct stat a {};
    struct stat b {};
    if (::lstat(one.c_str(), &a) != 0 || ::lstat(other.c_str(), &b) != 0) return false;
    if (a.st_dev == b.st_dev && a.st_ino == b.st_ino) return true;
    if (S_ISLNK(a.st_mode) && S_ISLNK(b.st_mode)) return fs::read_symlink(one) == fs::read_symlink(other);
    return S_ISREG(a.st_mode) && S_ISREG(b.st_mode) && a.st_size == b.st_size && sha256_of_file(one) == sha256_of_file(other);
} catch (const std::exception&) {   // not readable: they may differ
    return false;
}

std::string keep_beside(const fs::path& path, bool stays) {
    for (int number = 1;; ++number) {
        const std::string name = name_beside(path.filename().string(), number);
        const fs::path place = path.parent_path() / name;
        int error = stays && ::linkat(AT_FDCWD, path.c_str(), AT_FDCWD, place.c_str(), 0) == 0 ? 0 : stays ? errno : EPERM;
        if (error != 0 && error != EEXIST) error = move_to_free_name(path, place);
        if (error == ENOENT) return "";
        if (error == 0 || (error == EEXIST && is_same_file(path, place))) return name;
        if (error != EEXIST)
            throw OutputError(path.string(), std::string("cannot be kept under another name (") + std::strerror(error) + ")", remedy);
    }
}

std::vector<std::string> replace_listed(const fs::path& folder, const std::map<std::string, std::string>& files) {
    SumsList listed = sums_of(folder);
    if (!std::ranges::all_of(listed.paths, [&](const std::string& path) { return files.contains(path); }))
        listed = {};   // a list of other files
    std::vector<std::string> kept;
    std::string before, after;
    for (const auto& [name, bytes] : files) after += sha256(bytes) + "  " + name + "\n";
    for (const std::string& line : listed.lines) before += line + "\n";
    const auto keep = [&](const std::string& name) { kept.push_back(keep_beside(folder / name, true)); };
    if (!listed.is_there && may_be_there(folder / sums_file)) keep(sums_file);
    for (const auto& [name, bytes] : files) {
        const std::string digest = digest_of(folder / name);
        if (may_be_there(folder / name) && digest != sha256(bytes) && !listed.has(name, digest)) keep(name);
    }
    replace_file(folder / sums_file, before == after ? after : before + after);
    FileGroup group;
    for (const auto& [name, bytes] : files) group.add(folder / name, bytes);
    group.publish();
    if (!before.empty() && before != after) replace_file(folder / sums_file, after);
    return kept;
}

/// Puts the user's files into the successor of their folder.
class UserFiles::Carrier {
public:
    Carrier(fs::path from, fs::path to, bool moves) : from_(std::move(from)), to_(std::move(to)), moves_(moves) {}

    /// Links or moves a file. @return its path below the successor; empty: it is left for a later move, or gone
    fs::path carry(const Found& file) {
        const fs::path parent = folder_at(file.path.parent_path()), from = from_ / file.path;
        if (file.is_folder) return folder_at(file.path).lexically_relative(to_);
        for (int number = file.edited ? 1 : 0;; ++number) {
            const fs::path place = parent / name_beside(file.path.filename().string(), number);
            if (moves_ && is_same_file(from, place)) return place.lexically_relative(to_);   // already linked
            const int error =
                moves_ ? move_to_free_name(from, place) : (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, place.c_str(), 0) == 0 ? 0 : errno);
            if (error == 0 || (error == EEXIST && is_same_file(from, place))) return place.lexically_relative(to_);
            if (error == EEXIST) continue;
            const bool no_link = error == EPERM || error == EACCES || error == EOPNOTSUPP || error == ENOSYS || error == EMLINK;
            const auto can_be_moved = [&] { return ::faccessat(AT_FDCWD, from.parent_path().c_str(), W_OK | X_OK, AT_EACCESS) == 0; };
            if (error == ENOENT || (!moves_ && no_link && can_be_moved())) return {};
            throw OutputError(from.string(), std::string("cannot be carried over to the new folder (") + std::strerror(error) + ")",
                              remedy);
        }
    }

    /// Gives new folders the mode, the owner and the times of their originals, the inner ones first.
    void finish() const {
        for (auto made = made_.rbegin(); made != made_.rend(); ++made) {
            struct stat status {};
            if (::lstat(made->first.c_str(), &status) != 0) continue;
            const timespec times[] = {status.st_atim, status.st_mtim};
            // Only root may change the owner, and some file systems keep no times: neither is a reason to fail.
            if (::geteuid() == 0 && ::lchown(made->second.c_str(), status.st_uid, status.st_gid) != 0) continue;
            ::chmod(made->second.c_str(), status.st_mode & 07777);
            ::utimensat(AT_FDCWD, made->second.c_str(), times, AT_SYMLINK_NOFOLLOW);
        }
    }

private:
    fs::path from_, to_;
    bool moves_;
    std::map<fs::path, fs::path> folders_;              // below `from_` → where its files go
    std::vector<std::pair<fs::path, fs::path>> made_;   // from, to

    fs::path folder_at(const fs::path& below) {
        if (below.empty()) return to_;
        const auto known = folders_.find(below);
        if (known != folders_.end()) return known->second;
        const fs::path parent = folder_at(below.parent_path());
        for (int number = 0;; ++number) {
            const fs::path place = parent / name_beside(below.filename().string(), number);
            const bool is_new = !is_folder(place);
            if (is_new && ::mkdir(place.c_str(), 0700) != 0) {
                if (errno == EEXIST) continue;
                throw OutputError(place.string(), std::string("cannot create the folder (") + std::strerror(errno) + ")", remedy);
            }
            if (is_new) made_.emplace_back(from_ / below, place);
            return folders_[below] = place;
        }
    }
};

UserFiles::UserFiles(fs::path folder) : folder_(std::move(folder)), listed_(sums_of(folder_)) { list({}); }

void UserFiles::list(const fs::path& below) {
    std::error_code error;
    std::vector<fs::path> names;
    for (fs::directory_iterator it(folder_ / below, error), end; !error && it != end; it.increment(error))
        names.push_back(it->path().filename());
    if (error == std::errc::no_such_file_or_directory) return;
    if (error) refuse(folder_ / below, "cannot be listed (" + error.message() + ")");
    std::sort(names.begin(), names.end());
    const bool is_of_every_report = below == "images" || below == "meshes" || below == "tables";
    if (names.empty() && !below.empty() && !is_of_every_report) found_.push_back({below, false, true});
    for (const fs::path& name : names) {
        struct stat status {};
        const fs::path path = below / name;
        if (::lstat((folder_ / path).c_str(), &status) == 0) take(path, status);
    }
}

void UserFiles::take(const fs::path& path, const struct stat& status) {
    const bool is_at_top = path.parent_path().empty(), is_directory = S_ISDIR(status.st_mode);
    if (is_at_top) {
        const std::string name = path.string();
        if (name == sums_file && listed_.is_there) return;
        if (is_directory && process_in_name(name, ".meshfolio.tmp-") != 0) return;   // of a run into a mount point
        for (const FolderKind& kind : {report_folder, marks_folder})
            if (name == kind.marker && has_mark(folder_, kind)) return;
    }
    const std::string name = path.generic_string();
    const bool is_listed = listed_.paths.contains(name) && name != ".gitignore";   // earlier versions listed that
    if (is_listed && S_ISREG(status.st_mode)) {
        unsure_.push_back({name,
                           {status.st_ino,
                            status.st_size,
                            {status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ctim.tv_sec, status.st_ctim.tv_nsec}}});
        return;
    }
    if (is_mount_point(folder_ / path)) refuse(folder_ / path, "is a mount point");
    if (is_directory) list(path);
    else found_.push_back({path, is_listed, false});
}

void UserFiles::examine() {
    found_.clear();
    unsure_.clear();
    listed_ = sums_of(folder_);
    list({});
    std::vector<char> is_ours(unsure_.size());
    tbb::parallel_for(std::size_t{0}, unsure_.size(), [&](std::size_t i) {
        const auto& [path, stamp] = unsure_[i];
        const auto known = ours_.find(path);
        try {
            is_ours[i] = (known != ours_.end() && known->second == stamp) || listed_.has(path, sha256_of_file(folder_ / path));
        } catch (const InputError&) {   // not readable: it may have been edited
        }
    });
    ours_.clear();
    for (std::size_t i = 0; i < unsure_.size(); ++i) {
        if (is_ours[i]) ours_.insert(unsure_[i]);
        else found_.push_back({unsure_[i].first, true, false});
    }
}

void UserFiles::note(const Found& file, const fs::path& successor) {
    if (file.edited || file.path == ".gitignore" || may_be_there(successor / file.path)) return;
    if (!counted_.insert(file.path.string()).second) return;
    fs::path part;   // the first that the successor does not have yet: "notes/" of "notes/a/b"
    for (const fs::path& name : file.path) {
        part /= name;
        if (!may_be_there(successor / part)) break;
    }
    kept_.insert(part == file.path ? part.string() : part.string() + "/");
}

void UserFiles::carry(const fs::path& successor, bool moves) {
    // Files that keep their names come first: another file may be about to get the same name.
    std::stable_partition(found_.begin(), found_.end(),
                          [&](const Found& file) { return !file.edited && !may_be_there(successor / file.path); });
    for (const Found& file : found_) note(file, successor);
    Carrier carrier(folder_, successor, moves);
    for (const Found& file : found_) {
        const fs::path place = carrier.carry(file);
        if (!place.empty() && place != file.path) renamed_.insert(place.string());
    }
    carrier.finish();
}

void UserFiles::make_way_for(const fs::path& incoming) {
    const auto move_beside = [&](const fs::path& path) {
        if (const std::string name = keep_beside(folder_ / path, false); !name.empty())
            renamed_.insert((path.parent_path() / name).string());
    };
    for (const Found& file : found_) {
        note(file, incoming);
        fs::path part;
        bool is_moved = false;
        for (const fs::path& name : file.path) {
            part /= name;
            if (is_moved || !may_be_there(incoming / part)) break;
            const bool both_folders = is_folder(incoming / part) && (part != file.path || file.is_folder);
            if (both_folders || is_same_file(folder_ / part, incoming / part)) continue;
            move_beside(part);
            is_moved = true;
        }
        if (file.edited && !is_moved) move_beside(file.path);
    }
}

void UserFiles::remove_ours(const std::set<std::string>& incoming) const {
    std::error_code ignored;
    for (const auto& [path, stamp] : ours_) {
        if (incoming.contains(path)) continue;
        fs::remove(folder_ / path, ignored);
        for (fs::path parent = fs::path(path).parent_path(); !parent.empty(); parent = parent.parent_path())
            if (!fs::remove(folder_ / parent, ignored)) break;   // not empty
    }
}

std::vector<std::string> UserFiles::notes(const fs::path& where) const {
    std::vector<std::string> lines;
    const auto files = [](std::size_t count) { return std::to_string(count) + (count == 1 ? " file" : " files"); };
    const auto named = [](const std::set<std::string>& names) { return first_of_many({names.begin(), names.end()}); };
    if (!kept_.empty()) lines.push_back(where.string() + ": kept " + files(counted_.size()) + " of yours: " + named(kept_));
    if (!renamed_.empty())
        lines.push_back(where.string() + ": kept " + files(renamed_.size()) + " that you changed, beside the new: " + named(renamed_));
    return lines;
}

}   // namespace meshfolio::output
