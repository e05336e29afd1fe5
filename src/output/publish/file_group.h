/// @file
/// Files that appear all at once: each written beside its place and on the disk before the first takes it.
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
    /// Protects an input file: adding an output of that name fails. Call it before add().
    void keep(const std::filesystem::path& input);

    /// Writes `bytes` beside `path`; thread-safe. What is not a regular file (a device, a FIFO) is written at once.
    /// @throws OutputError; UsageError for a file that is kept or in the group already
    void add(const std::filesystem::path& path, std::string_view bytes);

    /// Puts every file in its place, or none: earlier ones are taken back if one fails. Call it once.
    /// @throws OutputError
    void publish();

private:
    struct Member {
        Member(std::filesystem::path asked_for, std::filesystem::path its_target, std::filesystem::path beside)
            : asked(std::move(asked_for)), target(std::move(its_target)), part(std::move(beside)) {}
        std::filesystem::path asked, target;   // as it was named, and with links followed
        Temporary part;
        enum class State { waiting, fresh, exchanged, replaced } state = State::waiting;
    };
    std::set<std::filesystem::path> kept_;
    std::mutex adding_;
    std::deque<Member> members_;   // a deque: references to members stay valid

    static void place(Member& member);
    void sync_folders() const;
    void take_back() noexcept;
};

/// Creates or replaces one file all at once. @throws OutputError
void replace_file(const std::filesystem::path& path, std::string_view bytes);

}   // namespace meshfolio::output
