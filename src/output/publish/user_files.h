/// @file
/// The user's files in a folder of ours: those that SHA256SUMS does not list, and those that are listed and were edited since.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/publish/file_sums.h"

namespace meshfolio::output {

class UserFiles {
public:
    /// Lists `folder` without following links; nothing is hashed yet.
    /// @throws OutputError where a folder in it cannot be listed, or a mount point in it would be carried along
    explicit UserFiles(std::filesystem::path folder);

    /// Lists it again and compares the listed files with their sums, in parallel; files that did not change since the last call are not
    /// read again. @throws OutputError as above
    void examine();

    /// Returns whether anything of the user's was found.
    bool any() const { return !found_.empty(); }

    /// Gives each file of the user's a second name in `successor`: under its own name, or as NAME.edited where that is taken or the file
    /// was listed. Files that cannot have two names (another owner, a file system without hard links) are left to move_into().
    /// @throws OutputError where one can neither be linked nor moved
    void link_into(const std::filesystem::path& successor) { carry(successor, false); }

    /// Moves what `successor` does not have yet. @throws OutputError
    void move_into(const std::filesystem::path& successor) { carry(successor, true); }

    /// Renames, within the folder, what is in the way of the files of `incoming`. @throws OutputError
    void make_way_for(const std::filesystem::path& incoming);

    /// Removes the listed files that are as we wrote them and `incoming` does not have, and the folders they leave empty.
    void remove_ours(const std::set<std::string>& incoming = {}) const;

    /// The folder has another name now.
    void renamed(std::filesystem::path folder) { folder_ = std::move(folder); }

    /// What SHA256SUMS lists.
    const SumsList& listed() const { return listed_; }

    /// Returns lines that tell what was kept, at most one of each kind. @param where  the folder the files are in now
    std::vector<std::string> notes(const std::filesystem::path& where) const;

private:
    struct Found {
        std::filesystem::path path;   // below the folder
        bool edited = false;          // listed, with another digest
        bool is_folder = false;       // an empty one
    };
    struct Stamp {
        ino_t inode = 0;
        off_t size = 0;
        long changed[4] = {};   // modification and change, seconds and nanoseconds
        bool operator==(const Stamp&) const = default;
    };
    class Carrier;

    std::filesystem::path folder_;
    SumsList listed_;
    std::vector<Found> found_;
    std::vector<std::pair<std::string, Stamp>> unsure_;   // listed, to be hashed
    std::map<std::string, Stamp> ours_;                   // listed, as we wrote them
    std::set<std::string> kept_, renamed_;                // for notes()
    std::set<std::string> counted_;

    void list(const std::filesystem::path& below);
    void take(const std::filesystem::path& path, const struct stat& status);
    void carry(const std::filesystem::path& successor, bool moves);
    void note(const Found& file, const std::filesystem::path& successor);
};

/// Gives what stands at `path` the first free name beside it (name_beside()): a second name, or another one.
/// @param stays  it is to be replaced at once, and keeps its own name until then where it can have two
/// @return the new name; empty: nothing is there @throws OutputError
std::string keep_beside(const std::filesystem::path& path, bool stays);

/// Replaces files in a folder that others use as well, and lists them alone in its SHA256SUMS. Those that are there and not as listed are
/// kept beside. At any moment the list has what stands in the folder, or what stood there.
/// @param files  name → bytes
/// @return the new names of those that were kept @throws OutputError
std::vector<std::string> replace_listed(const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

/// Returns whether both names stand for the same file, for files of the same bytes or for links to the same place.
bool is_same_file(const std::filesystem::path& one, const std::filesystem::path& other);

/// Returns the `number`-th name for a file that is kept beside: its own, NAME.edited, NAME.edited.2 …
std::string name_beside(const std::string& name, int number);

}   // namespace meshfolio::output
