#include "submission/handed_in.h"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/lower_case.h"
#include "mesh/io/mesh_files.h"

namespace meshfolio::submission {

namespace fs = std::filesystem;

namespace {

/// Returns why a path is malicious; empty if it is not. Any alphabet is allowed.
std::string trick_in(std::string_view path) {
    if (path.empty()) return "has no name";
    if (path.size() > 1024) return "has a name of " + std::to_string(path.size()) + " bytes";   // patterns are matched with it
    if (path.front() == '/') return "is an absolute path";
    if (path.find('\\') != path.npos) return "is written with backslashes";
    if (path.size() > 1 && path[1] == ':') return "names a drive";
    if (std::ranges::any_of(path, [](unsigned char c) { return c < 0x20 || c == 0x7f; })) return "has a control character";
    for (const fs::path& part : fs::path(path))
        if (part == "..") return "leads outside its folder";
    return "";
}

std::string megabytes_of(std::uintmax_t bytes) { return std::to_string(bytes >> 20) + " MB"; }
std::string normal(const std::string& path) { return fs::path(path).lexically_normal().generic_string(); }

/// Collects files within the limits.
class Collector {
public:
    Collector(std::string file, const HandInLimits& limits) : file_(std::move(file)), limits_(limits) {}

    [[noreturn]] void refuse(const std::string& problem) const {
        throw InputError({file_}, problem, "ask the student for another folder or zip");
    }
    [[noreturn]] void refuse_entry(const std::string& path, const std::string& problem) const {
        refuse(in_quotes(path, 80) + " " + problem);
    }

    /// Checks the path of an entry; to be called for every entry. Returns true if the entry is to be read.
    bool announce(const std::string& path, bool is_folder) {
        if (++entries_ > limits_.most_entries) refuse("has more than " + std::to_string(limits_.most_entries) + " entries");
        if (const std::string trick = trick_in(path); !trick.empty()) refuse_entry(path, trick);
        if (is_folder) return false;
        const std::string plain = normal(path);
        if (!paths_.insert(plain).second) refuse_entry(path, "is there twice");
        const std::string ending = lower_case_ending(plain);
        return ending == ".csv" || ending == ".toml" || std::ranges::count(meshes_, ending) > 0;
    }
    /// Refuses a file or a whole beyond the limits; to be called whenever `more` bytes of a file were read, `so_far` in all.
    void require_within_limits(const std::string& path, std::uintmax_t so_far, std::uintmax_t more) {
        total_ += more;
        if (so_far > limits_.largest_file) refuse_entry(path, "is larger than " + megabytes_of(limits_.largest_file));
        if (total_ > limits_.largest_total) refuse("has more than " + megabytes_of(limits_.largest_total) + " of files");
    }
    void require_ratio(std::uintmax_t packed) const {
        if (total_ > limits_.ratio_from && static_cast<double>(total_) > limits_.largest_ratio * static_cast<double>(packed))
            refuse("is a zip bomb: " + megabytes_of(total_) + " come out of " + std::to_string(packed) + " bytes");
    }
    void take(const std::string& path, std::string bytes) { files_[normal(path)] = std::move(bytes); }

    /// Returns the files without a common top folder: students often pack the folder instead of its contents.
    HandedIn files() && {
        const std::string first = files_.empty() ? "" : files_.begin()->first, top = first.substr(0, first.find('/') + 1);
        const bool in_one = !top.empty() && std::ranges::all_of(files_, [&](const auto& file) { return file.first.starts_with(top); });
        if (!in_one) return std::move(files_);
        HandedIn within;
        for (auto& [path, bytes] : files_) within[path.substr(top.size())] = std::move(bytes);
        return within;
    }

private:
    std::string file_;
    HandInLimits limits_;
    std::vector<std::string> meshes_ = mesh_endings();
    HandedIn files_;
    std::set<std::string> paths_;
    int entries_ = 0;
    std::uintmax_t total_ = 0;
};

HandedIn read_folder(const fs::path& folder, const HandInLimits& limits) {
    Collector collector(folder.string(), limits);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {   // does not follow links
        const std::string path = entry.path().lexically_relative(folder).generic_string();
        const fs::file_status status = entry.symlink_status();
        const bool wanted = collector.announce(path, fs::is_directory(status));
        if (fs::is_symlink(status)) collector.refuse_entry(path, "is a link");
        if (fs::is_directory(status)) continue;
        if (!fs::is_regular_file(status)) collector.refuse_entry(path, "is not a regular file");
        if (!wanted) continue;
        collector.require_within_limits(path, entry.file_size(), entry.file_size());
        collector.take(path, read_file(entry.path(), limits.largest_file));
    }
    return std::move(collector).files();
}

std::string reason_of(archive* reader) {
    const char* reason = archive_error_string(reader);
    return reason != nullptr ? reason : "libarchive failed";
}

/// Sets the locale of this thread to UTF-8 while it lives: libarchive drops names that the locale cannot represent.
class Utf8Names {
public:
    Utf8Names() : names_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(::uselocale(names_)) {}   // null changes nothing
    ~Utf8Names() {
        ::uselocale(before_);
        if (names_ != nullptr) ::freelocale(names_);
    }
    Utf8Names(const Utf8Names&) = delete;
    Utf8Names& operator=(const Utf8Names&) = delete;

private:
    locale_t names_, before_;
};

std::string entry_bytes(archive* reader, const std::string& path, std::uintmax_t packed, Collector& collector) {
    std::string bytes;
    std::vector<char> piece(std::size_t{1} << 16);
    for (;;) {
        const la_ssize_t read = archive_read_data(reader, piece.data(), piece.size());
        if (read < 0) collector.refuse_entry(path, "cannot be unpacked (" + reason_of(reader) + ")");
        if (read == 0) return bytes;
        bytes.append(piece.data(), static_cast<std::size_t>(read));
        collector.require_within_limits(path, bytes.size(), static_cast<std::uintmax_t>(read));
        collector.require_ratio(packed);
    }
}

}   // namespace

HandedIn unpacked(std::string_view zip, const std::string& file, const HandInLimits& limits) {
    const Utf8Names utf8;
    Collector collector(file, limits);
    const std::unique_ptr<archive, decltype(&archive_read_free)> owner(archive_read_new(), &archive_read_free);
    archive* const reader = owner.get();
    if (archive_read_support_format_zip(reader) != ARCHIVE_OK || archive_read_open_memory(reader, zip.data(), zip.size()) != ARCHIVE_OK)
        collector.refuse("is no zip (" + reason_of(reader) + ")");
    archive_entry* entry = nullptr;
    for (int code = ARCHIVE_OK; (code = archive_read_next_header(reader, &entry)) != ARCHIVE_EOF;) {
        if (code != ARCHIVE_OK && code != ARCHIVE_WARN) collector.refuse("is no readable zip (" + reason_of(reader) + ")");
        const char* name = archive_entry_pathname(entry);   // in any encoding; libarchive turns backslashes of Windows into slashes
        const std::string path = name != nullptr ? name : "";
        const auto type = archive_entry_filetype(entry);
        const bool wanted = collector.announce(path, type == AE_IFDIR);
        if (type == AE_IFLNK || archive_entry_symlink(entry) != nullptr) collector.refuse_entry(path, "is a link");
        if (type != AE_IFREG && type != AE_IFDIR) collector.refuse_entry(path, "is not a regular file");
        if (archive_entry_is_encrypted(entry) != 0) collector.refuse_entry(path, "is encrypted");
        if (wanted) collector.take(path, entry_bytes(reader, path, zip.size(), collector));
    }
    return std::move(collector).files();
}

HandedIn read_handed_in(const fs::path& path, const HandInLimits& limits) try {
    if (fs::is_directory(path)) return read_folder(path, limits);
    return unpacked(read_file(path, limits.largest_total), path.string(), limits);
} catch (const fs::filesystem_error& error) {
    throw InputError({path.string()}, "cannot be read (" + error.code().message() + ")", "check its rights");
}

}   // namespace meshfolio::submission
