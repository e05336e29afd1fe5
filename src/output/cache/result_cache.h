/// @file
/// Results of earlier runs: bytes under a key, and files by their content. Bytes that do not match their digest are removed and count as
/// missing. Runs may share a cache; every change is one rename. Above the limit, the least recently used files are removed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace meshfolio::output {

/// Returns $XDG_CACHE_HOME/meshfolio, else ~/.cache/meshfolio; nothing if neither variable holds an absolute path.
std::optional<std::filesystem::path> default_cache_folder();

/// Makes a key, 64 hexadecimal digits, from a list of words; different lists have different keys.
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

    /// Creates the folder if it is missing.
    /// @param limit  largest size of all files [bytes], for trim() @throws OutputError if it cannot be used
    ResultCache(std::filesystem::path folder, std::uintmax_t limit);

    /// Returns the bytes that put() stored under a key; nothing if they are missing or damaged.
    std::optional<std::string> get(const std::string& key);
    /// Stores bytes under a key, in place of earlier ones. @throws OutputError
    void put(const std::string& key, std::string_view bytes);

    /// Returns the bytes with this SHA-256, as keep() stored them; nothing if they are missing or damaged.
    std::optional<std::string> bytes_of(const std::string& digest);
    /// Stores bytes under their SHA-256, unless they are there. (A hard link would be faster; but then a change of one report in place
    /// would change the cache.)
    /// @return their SHA-256
    /// @throws OutputError
    std::string keep(std::string_view bytes);

    /// Removes the least recently used files until all together are within the limit.
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
