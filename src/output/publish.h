/// @file
/// A folder that appears all at once: built beside its final place, then exchanged with what was there by one rename.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace meshfolio::output {

/// The marker file that tells a folder made by us.
inline constexpr const char* marker_file = ".meshfolio";

class Publication {
public:
    /// Prepares `<target>.tmp-<pid>` beside `target` and sweeps leftovers of dead runs.
    /// @throws OutputError if the parent cannot be written, or `target` holds something that is not ours (neither the marker nor
    /// nothing but a .gitignore)
    explicit Publication(const std::filesystem::path& target);
    ~Publication();   // removes the temporary folder unless published
    Publication(const Publication&) = delete;
    Publication& operator=(const Publication&) = delete;

    const std::filesystem::path& folder() const { return folder_; }   // to write into

    /// Writes SHA256SUMS and the marker, carries over .gitignore, syncs, exchanges, removes the old one.
    /// @throws OutputError
    void publish();

private:
    std::filesystem::path target_, folder_;
    bool published_ = false;
};

/// Hexadecimal SHA-256.
std::string sha256(std::string_view bytes);

}   // namespace meshfolio::output
