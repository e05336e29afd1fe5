/// @file
/// A folder that appears all at once: built beside its final place, then exchanged with what was there by one rename.
/// Whatever happens in between — an error, a signal, a loss of power — the earlier folder stays whole.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace meshfolio::output {

/// The marker file of a report made by us.
inline constexpr const char* marker_file = ".meshfolio";
/// Folders that we replace as a whole. None takes the place of one of the other kind.
struct FolderKind {
    const char* marker;
    const char* words;
};
inline constexpr FolderKind report_folder{marker_file, "a report"}, marks_folder{".meshfolio-marks", "the marks of a class"};
/// Does a folder have the marker of either kind? False if it cannot be read.
bool is_marked(const std::filesystem::path& folder) noexcept;
/// Digests of every other file, in the format of sha256sum.
inline constexpr const char* sums_file = "SHA256SUMS";

/// One line of it.
struct FileSum {
    std::string digest;   // SHA-256, 64 hexadecimal digits
    long line = 0;        // in the list
};

/// By path. Paths are not checked: check them before writing to them.
/// @param file  the list, for messages
/// @throws InputError with the line that is not of the format
std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file);

/// `<target>.failed`, for a report that may not replace a better one.
std::filesystem::path failed_beside(const std::filesystem::path& target);

class OpenFolder;
class Temporary;

class Publication {
public:
    /// Prepares `<target>.tmp-<pid>` beside `target` and sweeps leftovers of dead runs. A target that is a symbolic link
    /// stands for what it points to; one that is a mount point is prepared inside.
    /// @throws OutputError if the parent cannot be written, a mount point is being written by another run, or `target` holds something that
    /// is not ours (neither the marker of this kind nor nothing but a .gitignore)
    explicit Publication(const std::filesystem::path& target, const FolderKind& kind = report_folder);
    ~Publication();   // removes the temporary folder unless published
    Publication(const Publication&) = delete;
    Publication& operator=(const Publication&) = delete;

    const std::filesystem::path& folder() const;   // to write into

    /// Digests that are known already, by path below the folder.
    using Digests = std::map<std::string, std::string>;

    /// Writes SHA256SUMS and the marker, carries over .gitignore, syncs, exchanges, removes the old one.
    /// @return  a warning for the user when the exchange could not be one atomic step, or the old one not be removed; else empty
    /// @throws OutputError
    std::string publish(const Digests& known = {});

    /// Redirects publish() to `<target>.failed`, for a report with failures while the target holds a good one.
    /// @throws OutputError if that cannot be written or holds something that is not ours
    void step_aside();
    /// Removes `<target>.failed`, which a good report makes obsolete.
    void remove_failed() const;

private:
    std::filesystem::path target_;
    FolderKind kind_;
    std::unique_ptr<Temporary> folder_;
    bool in_place_ = false;              // the target is a mount point
    std::unique_ptr<OpenFolder> lock_;   // of such a target, where two runs would mix their files
};

/// For an early end of the process, such as a signal: removes every temporary file and folder of this process and lets nothing more be
/// published. Never returns control to a publication that is under way.
/// @return whether something was published before
bool abandon_publications() noexcept;

}   // namespace meshfolio::output
