/// @file
/// The folder of a batch: a report a mesh in folders of their own, and the index of them.
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
    /// @throws OutputError if it holds what is neither of a batch nor a report, another run is writing there, or it cannot be written
    explicit BatchFolder(std::filesystem::path path);
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::optional<output::OpenFolder> lock_;
};

/// Writes index.html, batch.json, batch.csv and junit.xml, at most a few seconds behind. Thread-safe.
class BatchIndex {
public:
    /// @param templates  must outlive this
    BatchIndex(std::filesystem::path folder, report::Batch batch, const report::Templates& templates)
        : folder_(std::move(folder)), batch_(std::move(batch)), templates_(templates) {}

    /// Replaces each file, all at once. @throws OutputError
    void write();
    /// Replaces a row. Rewrites the files only if the last write was some seconds ago, as each holds all rows. @throws OutputError
    void set(std::size_t place, report::BatchRow row);
    /// Read it only after the last set().
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
