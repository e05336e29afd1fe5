#include "submission/zip_archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <memory>

#include "base/errors.h"

namespace meshfolio::submission {

namespace {

using Writer = std::unique_ptr<archive, decltype(&archive_write_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

/// @throws OutputError with libarchive's reason
void require(int code, archive* writer) {
    if (code != ARCHIVE_OK) {
        const char* reason = archive_error_string(writer);
        throw OutputError("submission.zip", std::string("cannot be packed (") + (reason ? reason : "libarchive failed") + ")");
    }
}

la_ssize_t append(archive*, void* zip, const void* bytes, std::size_t count) {
    static_cast<std::string*>(zip)->append(static_cast<const char*>(bytes), count);
    return static_cast<la_ssize_t>(count);
}

void add(archive* writer, const ZipEntry& file) {
    // No time: libarchive would write the local one beside it, which differs with the time zone.
    const Entry entry(archive_entry_new(), &archive_entry_free);
    archive_entry_set_pathname(entry.get(), file.path.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(file.bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), file.executable ? 0755 : 0644);
    archive_entry_set_uid(entry.get(), 0);
    archive_entry_set_gid(entry.get(), 0);
    require(archive_write_header(writer, entry.get()), writer);
    const la_ssize_t written = archive_write_data(writer, file.bytes.data(), file.bytes.size());
    require(written == static_cast<la_ssize_t>(file.bytes.size()) ? ARCHIVE_OK : ARCHIVE_FATAL, writer);
}

}   // namespace

std::string zip_of(const std::vector<ZipEntry>& entries) {
    std::string zip;
    const Writer writer(archive_write_new(), &archive_write_free);
    archive* const w = writer.get();
    require(archive_write_set_format_zip(w), w);
    require(archive_write_set_options(w, "zip:compression=deflate,zip:compression-level=9"), w);
    require(archive_write_set_bytes_in_last_block(w, 1), w);   // no padding
    require(archive_write_open(w, &zip, nullptr, append, nullptr), w);
    for (const ZipEntry& entry : entries) add(w, entry);
    require(archive_write_close(w), w);
    return zip;
}

}   // namespace meshfolio::submission
