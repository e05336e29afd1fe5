#include "output/publish/publish.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/linux_only.h"
#include "output/publish/folder_system.h"
#include "output/publish/temporaries.h"
#include "output/publish/user_files.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
    throw OutputError(path.string(), what + " (" + std::strerror(error) + ")", "check the rights and the free space there");
}

/// Returns the absolute path of a folder, with links followed and without a trailing slash.
fs::path resolved_folder(const fs::path& target) {
    std::error_code error;
    fs::path path = resolved(target, error);
    if (error || target.empty())
        throw OutputError(target.string(), "cannot be a folder (" + error.message() + ")", "choose another with --out");
    if (path.filename().empty()) path = path.parent_path();
    if (path.filename().empty()) throw OutputError(target.string(), "is the root of the file system", "choose another folder with --out");
    return path;
}

/// Removes permissions of other users that the replaced folder did not grant.
void keep_private(const fs::path& folder, const fs::path& target) {
    std::error_code error;
    const fs::file_status replaced = fs::status(target, error);
    if (!fs::is_directory(replaced)) return;
    const fs::perms others = fs::perms::group_all | fs::perms::others_all;
    fs::permissions(folder, others & ~replaced.permissions(), fs::perm_options::remove, error);
}

void sync_folders(const fs::path& folder) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (fs::is_directory(entry.symlink_status())) OpenFolder(entry.path()).sync();
    OpenFolder(folder).sync();
}

/// Opens and locks the folder as soon as no other run exchanges it; returns null if it is missing.
/// @throws OutputError if another run holds it for a minute
std::unique_ptr<OpenFolder> locked_folder(const fs::path& target) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (may_be_there(target)) {
        try {
            auto folder = std::make_unique<OpenFolder>(target);
            if (std::chrono::steady_clock::now() > end) folder->lock();   // throws
            if (folder->try_lock() && folder->is_in_its_place()) return folder;
        } catch (const OutputError&) {
            if (may_be_there(target)) throw;   // otherwise it was just renamed
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return nullptr;
}

/// Replaces a mount point, which cannot be renamed, file by file. Meanwhile its SHA256SUMS lists the old and the new version of each file,
/// so that the next run recognises both; the final SHA256SUMS comes last.
void place_file_by_file(const fs::path& folder, const fs::path& target, UserFiles& users) {
    const auto permission = permission_to_create();
    std::vector<std::string> files = files_below(folder);
    std::stable_partition(files.begin(), files.end(), [](const std::string& file) { return file != sums_file; });
    const auto put = [&](const std::string& from, const std::string& to) {
        make_folder((target / to).parent_path());
        if (const int error = rename_with(folder / from, target / to, Taken::replaced); error != 0)
            fail(target / to, "cannot be put in place", error);
    };
    users.make_way_for(folder);
    const std::string both = std::string(sums_file) + ".both";
    write_file(folder / both, (users.listed().is_there ? read_file(target / sums_file) : "") + read_file(folder / sums_file));
    put(both, sums_file);
    for (const std::string& file : files) put(file, file);
    users.remove_ours({files.begin(), files.end()});
    sync_folders(target);
    remember_publication();
}

}   // namespace

Publication::Publication(const fs::path& target, const FolderKind& kind) : target_(resolved_folder(target)), kind_(kind) {
    require_ours(target_, kind);
    make_folder(target_.parent_path());
    sweep_leftovers(target_);
    static_cast<void>(UserFiles(target_));   // refuses files that cannot be carried over before the work
    in_place_ = is_mount_point(target_);
    if (in_place_) {
        lock_ = std::make_unique<OpenFolder>(target_);
        lock_->lock();
    }
    const fs::path path =
        in_place_ ? target_ / (".meshfolio.tmp-" + process_number()) : fs::path(target_.string() + ".tmp-" + process_number());
    folder_ = std::make_unique<Temporary>(path);
    {
        const auto permission = permission_to_create();
        std::error_code error;
        if (!fs::create_directory(path, error))
            throw OutputError(path.string(), "cannot create the folder (" + (error ? error.message() : std::string("it exists")) + ")",
                              error ? "" : "remove it if no other run is at work");
    }
    keep_private(path, target_);
    write_file(path / kind.marker, kind.contents);
}

Publication::~Publication() = default;

const fs::path& Publication::folder() const { return folder_->path(); }

/// Returns the user's files in the target, which the caller has locked, before the exchange; null if the target is missing.
std::unique_ptr<UserFiles> Publication::users_of_target(const std::function<void()>& last_check) const {
    if (!may_be_there(target_)) return nullptr;
    require_ours(target_, kind_);
    if (last_check) last_check();
    auto users = std::make_unique<UserFiles>(target_);
    users->examine();
    return users;
}

/// Exchanges folder() with the target by one rename, or by two if the file system cannot exchange names: after a crash between the two,
/// the next run restores the old folder. Afterwards folder() is the old folder, or is gone.
/// @return 0 or errno
int Publication::exchange(const UserFiles* users, Notes& notes) {
    const int error = rename_with(folder(), target_, users == nullptr ? Taken::kept : Taken::exchanged);
    if (error != EINVAL && error != ENOSYS && error != EOPNOTSUPP) return error;
    const fs::path aside = target_.string() + ".old-" + process_number();
    const int moved = rename_with(target_, aside, Taken::replaced);
    if (moved != 0 && moved != ENOENT) fail(target_, "cannot be moved aside", moved);
    if (const int failed = rename_with(folder(), target_, Taken::replaced); failed != 0) {
        if (moved == 0) rename_with(aside, target_, Taken::replaced);
        fail(target_, "cannot be put in place", failed);
    }
    if (moved != 0) return 0;
    notes.warning = target_.string() + ": this file system cannot exchange folders, so the report was replaced in two steps";
    rename_with(aside, folder(), Taken::replaced);
    return 0;
}

/// Puts folder() in the place of the target. If another run has made the target meanwhile, tries again.
void Publication::place_by_rename(Notes& notes, const std::function<void()>& last_check) {
    const OpenFolder parent(target_.parent_path()), own(folder());
    own.lock();   // a run that replaces the new folder waits until the user's files are carried over
    int error = 0;
    for (int attempt = 0; attempt < 10; ++attempt) {
        const auto lock = locked_folder(target_);
        const auto users = users_of_target(last_check);
        if (users) users->link_into(folder());
        sync_folders(folder());
        const auto permission = permission_to_create();
        error = exchange(users.get(), notes);
        if (error == EEXIST || error == ENOTEMPTY || error == ENOENT) continue;
        if (error != 0) break;
        try {
            parent.sync();
        } catch (const OutputError&) {   // the rename may not survive a loss of power: restores the old folder
            const bool is_back = rename_with(target_, folder(), users ? Taken::exchanged : Taken::replaced) == 0;
            if (users && !is_back) take_the_rest(*users, notes);
            throw;
        }
        remember_publication();
        if (users) take_the_rest(*users, notes);
        return;
    }
    fail(target_, "the finished report cannot be put in its place", error);
}

/// Moves to the target the files that the user has changed since the links were made, and files that cannot be linked.
void Publication::take_the_rest(UserFiles& users, Notes& notes) {
    try {
        users.renamed(folder());
        users.examine();
        users.move_into(target_);
    } catch (const Error& error) {
        notes.warning = std::string(error.what()) + "; it stays in " + folder().string();
        folder_->keep();
    }
    notes.kept = users.notes(target_);
}

Notes Publication::publish(const Digests& known, const std::function<void()>& last_check) try {
    write_sums(folder(), known);
    Notes notes;
    if (in_place_) {
        const auto users = users_of_target(last_check);
        sync_folders(folder());
        place_file_by_file(folder(), target_, *users);
        notes = {target_.string() + ": is a mount point, so the report was replaced file by file", users->notes(target_)};
    } else {
        place_by_rename(notes, last_check);
    }
    if (!folder_->is_kept() && !folder_->remove())   // it may belong to another user
        notes.warning +=
            (notes.warning.empty() ? "" : "; ") + folder().string() + ": is left over and cannot be removed; delete it by hand";
    return notes;
} catch (const fs::filesystem_error& error) {
    throw OutputError(target_.string(), "cannot publish the report (" + error.code().message() + ")",
                      "check the rights and the free space there");
} catch (const InputError& error) {   // a new file cannot be read back
    throw OutputError(target_.string(), error.what());
}

fs::path failed_beside(const fs::path& target) { return (target.has_filename() ? target : target.parent_path()).string() + ".failed"; }

void Publication::step_aside() try {
    Publication aside(failed_beside(target_));
    std::swap(target_, aside.target_);
    if (!in_place_ && !aside.in_place_) return;
    // A rename cannot move the folder to another file system.
    fs::copy(folder(), aside.folder(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    keep_private(aside.folder(), aside.target_);
    std::swap(folder_, aside.folder_);
    std::swap(in_place_, aside.in_place_);
    std::swap(lock_, aside.lock_);
} catch (const fs::filesystem_error& error) {
    throw OutputError(target_.string(), "cannot publish the report (" + error.code().message() + ")",
                      "check the rights and the free space there");
}

std::vector<std::string> Publication::remove_failed() const {
    const fs::path failed = failed_beside(target_);
    std::error_code error;
    if (fs::is_symlink(failed, error) || !has_mark(failed, report_folder)) return {};
    UserFiles users(failed);
    users.examine();
    const auto permission = permission_to_create();
    if (users.any()) {
        users.remove_ours();
        fs::remove(failed / sums_file, error);   // only the user's files are left
        return {failed.string() + ": holds files of yours, and was not removed with the failed report"};
    }
    if (!in_place_ && rename_with(failed, folder(), Taken::kept) == 0)   // a name that is swept if the process ends here
        folder_->remove();
    else fs::remove_all(failed, error);
    return {};
}

}   // namespace meshfolio::output
