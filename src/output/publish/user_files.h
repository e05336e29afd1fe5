/// @file
/// The user's files in a folder that this program made: files that SHA256SUMS does not list, and listed files that were edited since.
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
    /// Lists `folder` without following links or computing digests.
    /// @throws OutputError if a folder in it cannot be listed or is a mount point
    explicit UserFiles(std::filesystem::path folder);

    /// Lists the folder again and compares its files with their sums, in parallel. Files that did not change since the last call are not
    /// read again. @throws OutputError like the constructor
    void examine();

    /// True if the folder holds a file of the user.
    bool any() const { return !found_.empty(); }

    /// Hard-links each file of the user into `successor`: under its own name, or as NAME.edited if that is taken or the file is listed.
    /// Files that cannot be linked (another owner, a file system without hard links) are left to move_into().
    /// @throws OutputError for a file that can neither be linked nor moved
    void link_into(const std::filesystem::path& successor) { carry(successor, false); }

    /// Moves the user's files that `successor` does not have yet into it, under names as link_into() gives them. @throws OutputError
    void move_into(const std::filesystem::path& successor) { carry(successor, true); }

    /// Renames the user's files within the folder that are in the way of the files of `incoming`. @throws OutputError
    void make_way_for(const std::filesystem::path& incoming);

    /// Removes the listed files that were not edited and are not among `incoming`, and the folders that become empty.
    void remove_ours(const std::set<std::string>& incoming = {}) const;

    /// Takes the new path of the folder after it was renamed.
    void renamed(std::filesystem::path folder) { folder_ = std::move(folder); }

    /// Returns the SHA256SUMS of the folder.
    const SumsList& listed() const { return listed_; }

    /// Returns at most two lines for the user: which files were kept, and which were renamed. @param where  the folder they are in now
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
    std::map<std::string, Stamp> ours_;                   // listed and not edited
    std::set<std::string> kept_, renamed_;                // for notes()
    std::set<std::string> counted_;

    void list(const std::filesystem::path& below);
    void take(const std::filesystem::path& path, const struct stat& status);
    void carry(const std::filesystem::path& successor, bool moves);
    void note(const Found& file, const std::filesystem::path& successor);
};

/// Renames the file at `path` to the first free name_beside().
/// @param stays  link it instead if possible: the caller replaces it under its old name at once
/// @return the new name; empty: there was no file @throws OutputError
std::string keep_beside(const std::filesystem::path& path, bool stays);

/// Replaces single files in a folder, which become the only files of its SHA256SUMS. Files of these names that are there and differ from
/// the list are kept under another name. At any moment the list covers the files as they are.
/// @param files  name → bytes
/// @return the new names of the kept files @throws OutputError
std::vector<std::string> replace_listed(const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

/// True if both paths name one file, files with equal bytes, or links to one path.
bool is_same_file(const std::filesystem::path& one, const std::filesystem::path& other);

/// Returns a name for a file that must make way: NAME for number 0, NAME.edited for 1, NAME.edited.2 for 2.
std::string name_beside(const std::string& name, int number);

}   // namespace meshfolio::output
