#include "run/batch/batch_folder.h"

#include "base/errors.h"
#include "base/file_bytes.h"
#include "build_info.h"
#include "output/publish/file_group.h"
#include "output/publish/publish.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// Reports of ours may be there before: parts that were merged. @throws OutputError for a folder that was somebody else's
void require_batch(const fs::path& folder) {
    if (!may_be_there(folder) || may_be_there(folder / batch_marker)) return;
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw OutputError(folder.string(), "is not a folder", "choose another with --out");
    fs::directory_iterator it(folder, error);
    for (; !error && it != fs::directory_iterator(); it.increment(error)) {
        if (it->path().filename() != ".gitignore" && !may_be_there(it->path() / output::marker_file))
            throw OutputError(folder.string(), "holds files that no batch of ours put there", "choose a new or empty folder with --out");
    }
    if (error) throw OutputError(folder.string(), "cannot be listed (" + error.message() + ")");
}

}   // namespace

BatchFolder::BatchFolder(fs::path path) : path_(std::move(path)) {
    require_batch(path_);
    output::make_folder(path_);
    lock_.emplace(path_);
    lock_->lock();
    output::replace_file(path_ / batch_marker,
                         "This folder was made by meshfolio batch: a report in each folder, index.html tells of all.\n");
}

void BatchIndex::write_unlocked() {
    output::FileGroup files;
    files.add(folder_ / "index.html", report::write_batch_page(batch_, build_info::version, templates_));
    files.add(folder_ / "batch.json", report::write_batch_json(batch_, build_info::version));
    files.add(folder_ / "batch.csv", report::write_csv(report::batch_table(batch_)));
    files.add(folder_ / "junit.xml", report::write_batch_junit(batch_));
    files.publish();
    written_ = std::chrono::steady_clock::now();
}

void BatchIndex::write() {
    const std::lock_guard lock(mutex_);
    write_unlocked();
}

void BatchIndex::set(std::size_t place, report::BatchRow row) {
    const std::lock_guard lock(mutex_);
    batch_.rows.at(place) = std::move(row);
    if (std::chrono::steady_clock::now() - written_ > std::chrono::seconds(3)) write_unlocked();
}

}   // namespace meshfolio::run
