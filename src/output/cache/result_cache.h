/// @file
/// What earlier runs made, to be taken instead of made again: bytes under a key, and files by their content. Nothing is trusted: whatever
/// does not have the digest it was stored with is removed and counts as not there. Runs may share a cache; every change is one rename. The
/// least recently used goes first when the cache grows over its limit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace meshfolio::output {

/// $XDG_CACHE_HOME/meshfolio, else ~/.cache/meshfolio; nothing where neither is set to an absolute path.
std::optional<std::filesystem::path> default_cache_folder();

/// A key from the words it is made of: no two lists of words have the same.
class KeyMaker {
public:
    KeyMaker& add(std::string_view word);
    std::string key() const;   // 64 hexadecimal digits

private:
    std::string words_;
};

class ResultCache {
public:
    struct Size {
        std::uintmax_t bytes = 0, files = 0;
    };

    /// Creates the folder. @throws OutputError if it cannot be used
    ResultCache(std::filesystem::path folder, std::uintmax_t limit);

    /// Bytes stored under a key, if they are there whole.
    std::optional<std::string> get(const std::string& key);
    /// @throws OutputError
    void put(const std::string& key, std::string_view bytes);

    /// Bytes by their SHA-256, as put() stores them without a key.
    std::optional<std::string> bytes_of(const std::string& digest);
    /// Stores bytes. A hard link to the file would be faster, but editing a picture of one report in place, or making it
    /// executable, would then change the cache and every other report.
    /// @return the SHA-256
    /// @throws OutputError
    std::string keep(std::string_view bytes);
    /// Puts the file with this SHA-256 at `target`, which must not exist. @return false if it is missing or damaged
    /// @throws OutputError
    bool place(const std::string& digest, const std::filesystem::path& target);

    /// Removes the least recently used until the rest fits the limit.
    void trim();
    Size size() const;
    /// Removes everything the cache has stored, and nothing else. @throws OutputError
    void clear();
    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
    std::uintmax_t limit_;

    std::filesystem::path object(const std::string& digest) const;
    std::filesystem::path entry(const std::string& key) const;
    void write_new(const std::filesystem::path& path, std::string_view bytes);
};

}   // namespace meshfolio::output
