/// @file
/// A folder that appears all at once: built beside its final place, then exchanged with the earlier folder by one rename.
/// An error, a signal or a loss of power before that leaves the earlier folder whole.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "output/publish/file_sums.h"
#include "output/publish/folder_marks.h"

namespace meshfolio::output {

/// Returns `<target>.failed`, the place of a report that may not replace a better one.
std::filesystem::path failed_beside(const std::filesystem::path& target);

class OpenFolder;
class Temporary;
class UserFiles;

/// Messages about a publication for the user.
struct Notes {
    std::string warning;             // the exchange took more than one step, or the old folder could not be removed; else empty
    std::vector<std::string> kept;   // lines that name files of the user that were kept
};

/// Replaces a folder that this program made. The user's files in it (user_files.h) stay.
class Publication {
public:
    /// Makes `<target>.tmp-<pid>` beside `target`, or inside it if it is a mount point, and sweeps leftovers of dead runs. A symbolic link
    /// is followed.
    /// @throws OutputError if the parent is not writable, another run writes to the mount point, require_ours() refuses `target`, or a
    /// file of the user cannot be carried over
    explicit Publication(const std::filesystem::path& target, const FolderKind& kind = report_folder);
    ~Publication();   // removes the temporary folder unless published
    Publication(const Publication&) = delete;
    Publication& operator=(const Publication&) = delete;

    const std::filesystem::path& folder() const;   // to write into

    using Digests = output::Digests;

    /// Writes SHA256SUMS, carries over the user's files, exchanges the folders and removes the old one. Runs into one target wait for each
    /// other. Returns messages for the user.
    /// @param known  digests of files in the folder
    /// @param last_check  called when no other run can change the old folder any more; may throw
    /// @throws OutputError
    Notes publish(const Digests& known = {}, const std::function<void()>& last_check = {});

    /// Redirects publish() to failed_beside(target), always; to be called when the report has failures and the target holds a good one.
    /// @throws OutputError if that folder cannot be written or was not made by this program
    void step_aside();
    /// Removes failed_beside(target), which a good report makes obsolete, except for the user's files in it.
    /// @return lines that name the kept files
    std::vector<std::string> remove_failed() const;

private:
    std::filesystem::path target_;
    FolderKind kind_;
    std::unique_ptr<Temporary> folder_;
    bool in_place_ = false;              // the target is a mount point
    std::unique_ptr<OpenFolder> lock_;   // of a mount point, where two runs would mix their files

    std::unique_ptr<UserFiles> users_of_target(const std::function<void()>& last_check) const;
    int exchange(const UserFiles* users, Notes& notes);
    void place_by_rename(Notes& notes, const std::function<void()>& last_check);
    void take_the_rest(UserFiles& users, Notes& notes);
};

}   // namespace meshfolio::output
