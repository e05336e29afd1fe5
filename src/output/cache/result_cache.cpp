#include "output/cache/result_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
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

constexpr std::size_t digest_length = 64;
constexpr const char* entries = "entries";
constexpr const char* objects = "objects";

bool is_digest(const std::string& text) {
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    return text.size() == digest_length && std::all_of(text.begin(), text.end(), is_digit);
}

/// Returns "ab/cdef…" for "abcdef…", which keeps folders short.
fs::path spread(const std::string& digest) { return fs::path(digest.substr(0, 2)) / digest.substr(2); }

/// Returns the bytes of a file, which then counts as used now; nothing if it is missing or not whole. A file that is not whole is removed.
template <class IsWhole> std::optional<std::string> read_whole(const fs::path& path, const IsWhole& is_whole) try {
    std::string bytes = read_file(path);
    if (!is_whole(bytes)) {
        std::error_code ignored;
        fs::remove(path, ignored);
        return {};
    }
    const timespec times[2] = {{0, UTIME_NOW}, {0, UTIME_OMIT}};   // the time of the last change is left alone
    ::utimensat(AT_FDCWD, path.c_str(), times, 0);
    return bytes;
} catch (const InputError&) {
    return {};
}

struct StoredFile {
    fs::path path;
    std::uintmax_t bytes = 0;
    timespec used = {};
};

std::vector<StoredFile> files_in(const fs::path& folder) {
    std::vector<StoredFile> files;
    for (const char* part : {entries, objects}) {
        std::error_code error;
        for (fs::recursive_directory_iterator it(folder / part, error), end; !error && it != end; it.increment(error)) {
            struct stat status {};
            if (::lstat(it->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
            files.push_back({it->path(), static_cast<std::uintmax_t>(status.st_size), status.st_atim});
        }
    }
    return files;
}

}   // namespace

std::optional<fs::path> default_cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && fs::path(cache).is_absolute()) return fs::path(cache) / "meshfolio";
    const char* home = std::getenv("HOME");
    if (home != nullptr && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "meshfolio";
    return {};
}

KeyMaker& KeyMaker::add(std::string_view word) {
    words_ += std::to_string(word.size()) + ":";
    words_ += word;
    return *this;
}

std::string KeyMaker::key() const { return sha256(words_); }

ResultCache::ResultCache(fs::path folder, std::uintmax_t limit) : folder_(std::move(folder)), limit_(limit) {
    make_folder(folder_ / entries);
    make_folder(folder_ / objects);
    if (::access((folder_ / entries).c_str(), W_OK | X_OK) != 0 || ::access((folder_ / objects).c_str(), W_OK | X_OK) != 0)
        throw OutputError(folder_.string(), "cannot be written", "let XDG_CACHE_HOME name another folder");
    sweep_file_leftovers(folder_);
}

fs::path ResultCache::object(const std::string& digest) const { return folder_ / objects / spread(digest); }
fs::path ResultCache::entry(const std::string& key) const { return folder_ / entries / spread(key); }

/// Writes atomically but without fsync: the digest reveals what a power loss leaves incomplete.
void ResultCache::write_new(const fs::path& path, std::string_view bytes) {
    static std::atomic<int> number = 0;
    make_folder(path.parent_path());
    const Temporary part(folder_ / (".meshfolio.part-" + process_number() + "-" + std::to_string(number++)));
    write_part(part, bytes, false);
    if (const int error = rename_with(part.path(), path, Taken::replaced); error != 0)
        throw OutputError(path.string(), std::string("cannot be put in place (") + std::strerror(error) + ")",
                          "check the rights and the free space there");
}

std::optional<std::string> ResultCache::get(const std::string& key) {
    const auto is_whole = [](std::string_view stored) {
        return stored.size() >= digest_length && stored.substr(0, digest_length) == sha256(stored.substr(digest_length));
    };
    auto stored = read_whole(entry(key), is_whole);
    if (stored) stored->erase(0, digest_length);
    return stored;
}

void ResultCache::put(const std::string& key, std::string_view bytes) { write_new(entry(key), sha256(bytes) + std::string(bytes)); }

std::optional<std::string> ResultCache::bytes_of(const std::string& digest) {
    if (!is_digest(digest)) return {};
    return read_whole(object(digest), [&](std::string_view bytes) { return sha256(bytes) == digest; });
}

std::string ResultCache::keep(std::string_view bytes) {
    std::string digest = sha256(bytes);
    if (!bytes_of(digest)) write_new(object(digest), bytes);   // not there, or damaged and removed
    return digest;
}

void ResultCache::trim() {
    std::vector<StoredFile> files = files_in(folder_);
    std::uintmax_t total = 0;
    for (const StoredFile& file : files) total += file.bytes;
    if (total <= limit_) return;
    const auto earlier = [](const StoredFile& a, const StoredFile& b) {
        return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
    };
    std::sort(files.begin(), files.end(), earlier);
    for (const StoredFile& file : files) {
        if (total <= limit_) break;
        std::error_code ignored;
        fs::remove(file.path, ignored);
        total -= file.bytes;
    }
}

ResultCache::Size ResultCache::size() const {
    Size size;
    for (const StoredFile& file : files_in(folder_)) {
        size.bytes += file.bytes;
        ++size.files;
    }
    return size;
}

void ResultCache::clear() {
    for (const char* part : {entries, objects}) {
        std::error_code error;
        fs::remove_all(folder_ / part, error);
        if (error) throw OutputError((folder_ / part).string(), "cannot be removed (" + error.message() + ")", "remove it by hand");
    }
}

}   // namespace meshfolio::output
