/// @file
/// Files that appear all at once: all are written beside their places and flushed to the disk before the first is renamed.
#pragma once

#include <deque>
#include <filesystem>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "output/publish/temporaries.h"

namespace meshfolio::output {

class FileGroup {
public:
    /// Protects an input file: add() refuses an output at its path. To be called before add().
    void keep(const std::filesystem::path& input);

    /// Writes `bytes` to a temporary file beside `path`, for publish(); thread-safe. A device or a FIFO is written to at once.
    /// @throws OutputError; UsageError if the file is protected or in the group already
    void add(const std::filesystem::path& path, std::string_view bytes);

    /// Renames every file to its place, or none: if one fails, the files before it are restored. To be called once. @throws OutputError
    void publish();

private:
    struct Member {
        Member(std::filesystem::path asked_for, std::filesystem::path its_target, std::filesystem::path beside)
            : asked(std::move(asked_for)), target(std::move(its_target)), part(std::move(beside)) {}
        std::filesystem::path asked, target;   // as named, and with links followed
        Temporary part;
        enum class State { waiting, fresh, exchanged, replaced } state = State::waiting;
    };
    std::set<std::filesystem::path> kept_;
    std::mutex adding_;
    std::deque<Member> members_;   // a deque: references to members stay valid

    static void place(Member& member);
    void restore() noexcept;
};

/// Creates or replaces one file in one step. @throws OutputError
void replace_file(const std::filesystem::path& path, std::string_view bytes);

}   // namespace meshfolio::output
