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

/// The marker of such a folder; that of a report would let a report replace it as a whole.
inline constexpr const char* batch_marker = ".meshfolio-batch";

class BatchFolder {
public:
    /// Creates the folder where there is none, and keeps other runs out of it as long as this lives.
    /// @throws OutputError if it holds what is neither of a batch nor a report, another run is writing there, or it cannot be written
    explicit BatchFolder(std::filesystem::path path);
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::optional<output::OpenFolder> lock_;
};

/// index.html, batch.json, batch.csv and junit.xml, which tell what is known by now, or was a few seconds ago. Thread-safe.
class BatchIndex {
public:
    /// @param templates  must outlive this
    BatchIndex(std::filesystem::path folder, report::Batch batch, const report::Templates& templates)
        : folder_(std::move(folder)), batch_(std::move(batch)), templates_(templates) {}

    /// Replaces each file, all at once. @throws OutputError
    void write();
    /// Another row. The files follow once they have not been written for a while: each holds all rows. @throws OutputError
    void set(std::size_t place, report::BatchRow row);
    /// To be read when nobody sets rows any more.
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
