/// @file
/// The folder of a batch: one folder for the report of each mesh, and the index.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

#include "output/publish/folder_system.h"
#include "report/batch/batch.h"

namespace meshfolio::run {

class BatchFolder {
public:
    /// Creates the folder if it is missing, and locks it against other runs while this object lives.
    /// @throws OutputError if the folder holds other files, cannot be written, or another run is writing there
    explicit BatchFolder(std::filesystem::path path);
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::optional<output::OpenFolder> lock_;
};

/// The index: index.html, batch.json, batch.csv and junit.xml, a few seconds behind at most. Thread-safe.
class BatchIndex {
public:
    /// @param templates  must outlive this
    BatchIndex(std::filesystem::path folder, report::Batch batch, const report::Templates& templates)
        : folder_(std::move(folder)), batch_(std::move(batch)), templates_(templates) {}

    /// Writes index.html, batch.json, batch.csv and junit.xml; a file that the user changed is kept beside. @throws OutputError
    void write();
    /// Replaces a row. Writes the files if the last write was more than three seconds ago. @throws OutputError
    void set(std::size_t place, report::BatchRow row);
    /// Returns the batch with its rows. Not thread-safe: call it after the last set().
    const report::Batch& batch() const { return batch_; }

private:
    std::mutex mutex_;
    std::filesystem::path folder_;
    report::Batch batch_;
    const report::Templates& templates_;
    std::chrono::steady_clock::time_point written_ = {};

    void write_unlocked();
};

}   // namespace meshfolio::run
