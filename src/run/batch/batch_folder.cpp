#include "run/batch/batch_folder.h"

#include "base/errors.h"
#include "base/file_bytes.h"
#include "build_info.h"
#include "output/publish/file_group.h"
#include "output/publish/publish.h"
#include "output/publish/user_files.h"
#include "run/console.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

BatchFolder::BatchFolder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    output::require_ours(output::resolved(path_, error), output::batch_folder);
    output::make_folder(path_);
    lock_.emplace(path_);
    lock_->lock();
    output::replace_file(path_ / output::batch_folder.marker, output::batch_folder.contents);
}

void BatchIndex::write_unlocked() {
    const std::vector<std::string> kept =
        output::replace_listed(folder_, {{"index.html", report::write_batch_page(batch_, build_info::version, templates_)},
                                         {"batch.json", report::write_batch_json(batch_, build_info::version)},
                                         {"batch.csv", report::write_csv(report::batch_table(batch_))},
                                         {"junit.xml", report::write_batch_junit(batch_)}});
    for (const std::string& name : kept) complain(folder_.string() + ": kept a file that you changed, beside the new: " + name);
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
