/// @file
/// A folder that appears all at once: built beside its final place, then exchanged with what was there by one rename.
/// Whatever happens in between — an error, a signal, a loss of power — the earlier folder stays whole.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "output/publish/file_sums.h"
#include "output/publish/folder_marks.h"

namespace meshfolio::output {

/// `<target>.failed`, for a report that may not replace a better one.
std::filesystem::path failed_beside(const std::filesystem::path& target);

class OpenFolder;
class Temporary;
class UserFiles;

/// What to tell the user of a publication.
struct Notes {
    std::string warning;             // the exchange was not one atomic step, or the old folder could not be removed; else empty
    std::vector<std::string> kept;   // lines: files of the user's that were kept
};

/// Replaces a folder of ours. What in it is the user's (user_files.h) is in the new one as well.
class Publication {
public:
    /// Prepares `<target>.tmp-<pid>` beside `target` and sweeps leftovers of dead runs. A target that is a symbolic link
    /// stands for what it points to; one that is a mount point is prepared inside.
    /// @throws OutputError if the parent cannot be written, a mount point is being written by another run, `target` may not be replaced
    /// (require_ours()), or a file of the user's in it cannot be carried over
    explicit Publication(const std::filesystem::path& target, const FolderKind& kind = report_folder);
    ~Publication();   // removes the temporary folder unless published
    Publication(const Publication&) = delete;
    Publication& operator=(const Publication&) = delete;

    const std::filesystem::path& folder() const;   // to write into

    using Digests = output::Digests;

    /// Writes SHA256SUMS, carries over what is the user's, syncs, exchanges, removes the old folder. Of several runs one does so at a time.
    /// @param known  digests of files in the folder
    /// @param last_check  of the folder that is replaced, when no other run can change it any more; may throw
    /// @throws OutputError
    Notes publish(const Digests& known = {}, const std::function<void()>& last_check = {});

    /// Redirects publish() to `<target>.failed`, for a report with failures while the target holds a good one.
    /// @throws OutputError if that cannot be written or holds something that is not ours
    void step_aside();
    /// Removes `<target>.failed`, which a good report makes obsolete, but for what is the user's in it.
    /// @return lines that tell what was kept
    std::vector<std::string> remove_failed() const;

private:
    std::filesystem::path target_;
    FolderKind kind_;
    std::unique_ptr<Temporary> folder_;
    bool in_place_ = false;              // the target is a mount point
    std::unique_ptr<OpenFolder> lock_;   // of such a target, where two runs would mix their files

    std::unique_ptr<UserFiles> users_of_target(const std::function<void()>& last_check) const;
    int exchange(const UserFiles* users, Notes& notes);
    void place_by_one_rename(Notes& notes, const std::function<void()>& last_check);
    void take_the_rest(UserFiles& users, Notes& notes);
};

/// For an early end of the process, such as a signal: removes every temporary file and folder of this process and lets nothing more be
/// published. Never returns control to a publication that is under way.
/// @return whether something was published before
bool abandon_publications() noexcept;

}   // namespace meshfolio::output
