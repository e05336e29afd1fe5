#include "output/publish/publish.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/linux_only.h"
#include "base/sha256.h"
#include "output/publish/folder_system.h"
#include "output/publish/temporaries.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
    throw OutputError(path.string(), what + " (" + std::strerror(error) + ")");
}

/// The folder that the rename will name, without a trailing slash.
fs::path resolved_folder(const fs::path& target) {
    std::error_code error;
    fs::path path = resolved(target, error);
    if (error || target.empty()) throw OutputError(target.string(), "cannot be a folder (" + error.message() + ")");
    if (path.filename().empty()) path = path.parent_path();
    if (path.filename().empty()) throw OutputError(target.string(), "is the root of the file system", "choose another folder with --out");
    return path;
}

/// Removes permissions of others that the replaced folder did not grant.
void keep_private(const fs::path& folder, const fs::path& target) {
    std::error_code error;
    const fs::file_status replaced = fs::status(target, error);
    if (!fs::is_directory(replaced)) return;
    const fs::perms others = fs::perms::group_all | fs::perms::others_all;
    fs::permissions(folder, others & ~replaced.permissions(), fs::perm_options::remove, error);
}

/// @throws OutputError if replacing `target` would delete what we did not make, or what is of another kind
void require_ours(const fs::path& target, const FolderKind& kind) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(target, error);
    if (status.type() == fs::file_type::not_found) return;
    if (error) throw OutputError(target.string(), "cannot be examined (" + error.message() + ")");
    if (!fs::is_directory(status)) throw OutputError(target.string(), "is not a folder", "choose another with --out");
    bool foreign = false;
    fs::directory_iterator it(target, error);
    if (error) throw OutputError(target.string(), "cannot be listed (" + error.message() + ")");
    for (; it != fs::directory_iterator(); it.increment(error)) {
        const fs::path name = it->path().filename();
        if (name == kind.marker) return;
        if (name != ".gitignore" && process_in_name(name.string(), ".meshfolio.tmp-") == 0) foreign = true;
    }
    if (error) throw OutputError(target.string(), "cannot be listed (" + error.message() + ")");
    if (!foreign) return;
    std::string what = "files that no " + std::string(kind.marker == report_folder.marker ? "report" : "marks") + " of ours put there";
    for (const FolderKind& other : {report_folder, marks_folder})
        if (fs::exists(target / other.marker, error)) what = other.words;
    throw OutputError(target.string(), "holds " + what + ", and would be replaced", "choose a new or empty folder with --out");
}

/// Files below `folder`, relative to it, sorted by their bytes.
std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).generic_string());
    std::sort(files.begin(), files.end());
    return files;
}

void write_sums(const fs::path& folder, const Publication::Digests& known) {
    std::vector<std::string> files = files_below(folder);
    std::erase(files, sums_file);
    std::vector<std::string> digests(files.size());
    tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
        const auto it = known.find(files[i]);
        digests[i] = it != known.end() ? it->second : sha256_of_file(folder / files[i]);
    });
    std::string sums;
    for (std::size_t i = 0; i < files.size(); ++i) sums += digests[i] + "  " + files[i] + "\n";
    write_file(folder / sums_file, sums);
}

void sync_folders(const fs::path& folder) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_directory()) OpenFolder(entry.path()).sync();
    OpenFolder(folder).sync();
}

/// Two renames where the file system cannot exchange names. The next run can restore the old folder from its name.
/// @return whether there was one
bool replace_in_two_steps(const fs::path& folder, const fs::path& target, const FolderKind& kind) {
    require_ours(target, kind);
    const fs::path aside = target.string() + ".old-" + process_number();
    const int moved = rename_with(target, aside, Taken::replaced);
    if (moved != 0 && moved != ENOENT) fail(target, "cannot be moved aside", moved);
    if (const int error = rename_with(folder, target, Taken::replaced); error != 0) {
        if (moved == 0) rename_with(aside, target, Taken::replaced);
        fail(target, "cannot be put in place", error);
    }
    const Temporary replaced(aside);   // removed here
    return moved == 0;
}

enum class Placed { fresh, exchanged, unsupported };

/// `folder` becomes `target` by one rename. Two first runs may race: the second finds the name taken and exchanges.
Placed place(const fs::path& folder, const fs::path& target, const FolderKind& kind) {
    int error = 0;
    for (int attempt = 0; attempt < 10; ++attempt) {
        error = rename_with(folder, target, Taken::kept);
        if (error == 0) return Placed::fresh;
        if (error == EEXIST || error == ENOTEMPTY) {
            require_ours(target, kind);
            error = rename_with(folder, target, Taken::exchanged);
            if (error == 0) return Placed::exchanged;
        }
        if (error == EINVAL || error == ENOSYS || error == EOPNOTSUPP) return Placed::unsupported;
        if (error != ENOENT) break;
    }
    fail(target, "the finished report cannot be put in its place", error);
}

void place_by_one_rename(const fs::path& folder, const fs::path& target, const FolderKind& kind, std::string& note) {
    const OpenFolder parent(target.parent_path());
    const auto permission = permission_to_create();
    const Placed placed = place(folder, target, kind);
    if (placed == Placed::unsupported && replace_in_two_steps(folder, target, kind))
        note = target.string() + ": this file system cannot exchange folders, so the report was replaced in two steps";
    try {
        parent.sync();
    } catch (const OutputError&) {   // not known to last: better the old one
        if (placed == Placed::exchanged) rename_with(folder, target, Taken::exchanged);
        if (placed == Placed::fresh) rename_with(target, folder, Taken::replaced);
        throw;
    }
    remember_publication();
}

/// Replaces a mount point, which cannot be renamed, file by file. The sums come last, so that they reveal a mixture.
void place_file_by_file(const fs::path& folder, const fs::path& target) {
    const auto permission = permission_to_create();
    std::vector<std::string> files = files_below(folder);
    const std::vector<std::string> old = files_below(target);
    std::stable_partition(files.begin(), files.end(), [](const std::string& file) { return file != sums_file; });
    for (const std::string& file : files) {
        make_folder((target / file).parent_path());
        if (const int error = rename_with(folder / file, target / file, Taken::replaced); error != 0)
            fail(target / file, "cannot be put in place", error);
    }
    std::sort(files.begin(), files.end());
    for (const std::string& file : old) {
        const bool temporary = process_in_name(file, ".meshfolio.tmp-") != 0;
        if (!temporary && !std::binary_search(files.begin(), files.end(), file)) fs::remove(target / file);
    }
    sync_folders(target);
    remember_publication();
}

void create_folder(const fs::path& path) {
    const auto permission = permission_to_create();
    std::error_code error;
    if (!fs::create_directory(path, error))
        throw OutputError(path.string(), "cannot create the folder (" + (error ? error.message() : std::string("it exists")) + ")");
}

}   // namespace

Publication::Publication(const fs::path& target, const FolderKind& kind) : target_(resolved_folder(target)), kind_(kind) {
    require_ours(target_, kind);
    make_folder(target_.parent_path());
    sweep_leftovers(target_);
    in_place_ = is_mount_point(target_);
    if (in_place_) {
        lock_ = std::make_unique<OpenFolder>(target_);
        lock_->lock();
    }
    const fs::path path =
        in_place_ ? target_ / (".meshfolio.tmp-" + process_number()) : fs::path(target_.string() + ".tmp-" + process_number());
    folder_ = std::make_unique<Temporary>(path);
    create_folder(path);
    keep_private(path, target_);
    write_file(path / kind.marker, "This folder was made by meshfolio, which replaces it as a whole.\n");
}

Publication::~Publication() = default;

const fs::path& Publication::folder() const { return folder_->path(); }

std::string Publication::publish(const Digests& known) try {
    const fs::path kept = target_ / ".gitignore";
    if (fs::exists(kept)) write_file(folder() / ".gitignore", read_file(kept));
    write_sums(folder(), known);
    sync_folders(folder());
    std::string note;
    if (in_place_) {
        place_file_by_file(folder(), target_);
        note = target_.string() + ": is a mount point, so the report was replaced file by file";
    } else {
        place_by_one_rename(folder(), target_, kind_, note);
    }
    if (!folder_->remove())   // the earlier report, of another owner perhaps
        note += (note.empty() ? "" : "; ") + folder().string() + ": cannot be removed, though nobody needs it any more";
    return note;
} catch (const fs::filesystem_error& error) {
    throw OutputError(target_.string(), "cannot publish the report (" + error.code().message() + ")");
} catch (const InputError& error) {   // a file of ours that cannot be read back
    throw OutputError(target_.string(), error.what());
}

bool is_marked(const fs::path& folder) noexcept {
    std::error_code error;
    return fs::exists(folder / report_folder.marker, error) || fs::exists(folder / marks_folder.marker, error);
}

fs::path failed_beside(const fs::path& target) { return (target.has_filename() ? target : target.parent_path()).string() + ".failed"; }

void Publication::step_aside() try {
    Publication aside(failed_beside(target_));
    std::swap(target_, aside.target_);
    if (!in_place_ && !aside.in_place_) return;
    // Of two file systems: no rename leads from one to the other.
    fs::copy(folder(), aside.folder(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    keep_private(aside.folder(), aside.target_);
    std::swap(folder_, aside.folder_);
    std::swap(in_place_, aside.in_place_);
    std::swap(lock_, aside.lock_);
} catch (const fs::filesystem_error& error) {
    throw OutputError(target_.string(), "cannot publish the report (" + error.code().message() + ")");
}

void Publication::remove_failed() const {
    const fs::path failed = failed_beside(target_);
    std::error_code error;
    if (!fs::is_regular_file(failed / marker_file, error)) return;
    const auto permission = permission_to_create();
    if (!in_place_ && rename_with(failed, folder(), Taken::kept) == 0)   // a name that is swept if we end here
        folder_->remove();
    else
        fs::remove_all(failed, error);
}

bool abandon_publications() noexcept { return remove_all_temporaries(); }

std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file) {
    constexpr std::size_t digits = 64, gap = 2;
    const auto is_digest = [](std::string_view word) { return word.find_first_not_of("0123456789abcdef") == std::string_view::npos; };
    std::map<std::string, FileSum> sums;
    long number = 0;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
        end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        ++number;
        if (line.size() <= digits + gap || line.compare(digits, gap, "  ") != 0 || !is_digest(std::string_view(line).substr(0, digits)))
            throw InputError({file.string(), number}, "is no line of sha256sum", "make the report again with meshfolio report");
        sums[line.substr(digits + gap)] = {line.substr(0, digits), number};
    }
    return sums;
}

}   // namespace meshfolio::output
