/// @file
/// Another program run to its end, within a limit of time, in a process group of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::report {

struct ChildTask {
    std::filesystem::path program;
    std::vector<std::string> arguments;               // without the program itself
    std::map<std::string, std::string> environment;   // takes the place of, or adds to, that of this process
    std::filesystem::path folder = "/";               // where it runs
    std::chrono::milliseconds limit = std::chrono::seconds(120);
    bool tidies_up = false;   // end_children() asks it to end, by SIGTERM, before it kills
    /// For a program that is talked with: it hears by its descriptor 3 and speaks by 4, each message ended by a zero byte. Called first
    /// with nothing, then with each message. @return what to say, perhaps nothing; nullopt: all is said, and the program is killed, as it
    /// is when a message exceeds 256 MB
    std::function<std::optional<std::string>(std::string_view message)> answer = {};
};

struct ChildEnd {
    enum class Kind { exited, killed, timed_out, not_started, dismissed } kind = Kind::not_started;
    int code = 0;         // exit code, signal, or errno of what could not be started
    std::string output;   // the last of what it wrote to both streams
};

/// Runs the program with no input and waits for its end. Whatever it leaves running in its group is killed.
ChildEnd run_child(const ChildTask& task);

/// Of what it wrote, without control characters; at most 300 bytes.
std::string last_line(const ChildEnd& end);

/// "ended with exit code 3", "was killed by signal 9", …, and the last line that it wrote.
std::string words_of(const ChildEnd& end);

/// For a failure elsewhere: kills all running children, and starts no more. Who waits for one goes on.
void abandon_children() noexcept;

/// For an early end of the process, such as a signal: kills all running children, within a second, and starts no more.
void end_children() noexcept;

}   // namespace meshfolio::report
