#include "output/publish/file_group.h"

#include <cerrno>
#include <cstring>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/linux_only.h"
#include "output/publish/folder_system.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

void FileGroup::keep(const fs::path& input) {
    std::error_code error;
    const fs::path file = resolved(input, error);
    if (!error) kept_.insert(file);
}

void FileGroup::add(const fs::path& path, std::string_view bytes) {
    if (is_stream(path)) return write_file(path, bytes);
    const fs::path target = place_of_file(path), folder = target.parent_path();
    if (kept_.contains(target)) throw UsageError(path.string() + " is the input itself", "give the output a name of its own");
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    const auto member = [&]() -> Member* {
        static int number = 0;
        static std::mutex numbering;   // of all groups
        const std::scoped_lock lock(adding_, numbering);
        for (const Member& other : members_)
            if (other.target == target) throw UsageError(path.string() + " is named for two outputs", "give each a name of its own");
        sweep_file_leftovers(folder);
        return &members_.emplace_back(path, target, folder / (".meshfolio.part-" + process_number() + "-" + std::to_string(number++)));
    }();
    try {
        const bool replaces = fs::exists(status);
        write_part(member->part, bytes, true,
                   replaces ? status.permissions() : new_file_permissions);   // never more permissive than the file it replaces
        // The umask may have taken rights away: restores them if possible. The owner may change: nothing runs as another user.
        if (replaces) fs::permissions(member->part.path(), status.permissions() & fs::perms::all, error);
    } catch (const OutputError& failure) {   // the message names the file that was asked for
        throw OutputError(path.string(), std::string("cannot be written: ") + failure.what());
    }
}

/// Renames a file to its place. The file that it replaces gets the temporary name if the file system can exchange names.
void FileGroup::place(Member& member) {
    const fs::path& part = member.part.path();
    int error = rename_with(part, member.target, Taken::kept);
    member.state = Member::State::fresh;
    if (error == EEXIST) {
        error = rename_with(part, member.target, Taken::exchanged);
        member.state = Member::State::exchanged;
        std::error_code ignored;
        if (error == 0 && fs::is_directory(fs::symlink_status(part, ignored)))   // made meanwhile
            throw OutputError(member.asked.string(), "is a folder", "give the output another name");
    }
    if (error == EINVAL || error == ENOSYS || error == EOPNOTSUPP || error == ENOENT) {   // ENOENT: removed meanwhile
        error = rename_with(part, member.target, Taken::replaced);
        member.state = Member::State::replaced;
    }
    if (error == 0) return;
    member.state = Member::State::waiting;
    throw OutputError(member.asked.string(), std::string("cannot be put in place (") + std::strerror(error) + ")",
                      "check the rights and the free space there");
}

/// Undoes the renames, last first.
void FileGroup::restore() noexcept {
    for (auto member = members_.rbegin(); member != members_.rend(); ++member) {   // Clang 14 knows no std::views::reverse
        if (member->state == Member::State::exchanged) rename_with(member->part.path(), member->target, Taken::exchanged);
        if (member->state == Member::State::fresh) rename_with(member->target, member->part.path(), Taken::kept);
    }
}

void FileGroup::publish() {
    const auto permission = permission_to_create();
    try {
        for (Member& member : members_) place(member);
        std::set<fs::path> folders;
        for (const Member& member : members_) folders.insert(member.part.path().parent_path());
        for (const fs::path& folder : folders) OpenFolder(folder).sync();
    } catch (const OutputError&) {
        restore();
        throw;
    }
    remember_publication();
}

void replace_file(const fs::path& path, std::string_view bytes) {
    FileGroup group;
    group.add(path, bytes);
    group.publish();
}

}   // namespace meshfolio::output
