/// @file
/// Runs another program to its end, within a limit of time, in a process group of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace meshfolio {

struct ChildTask {
    std::filesystem::path program;
    std::vector<std::string> arguments;               // without the program itself
    std::map<std::string, std::string> environment;   // replaces variables of this process, or adds to them
    std::filesystem::path folder = "/";               // working directory
    std::chrono::milliseconds limit = std::chrono::seconds(120);
    bool tidies_up = false;   // end_children() sends SIGTERM and waits before it kills
};

struct ChildEnd {
    enum class Kind { exited, killed, timed_out, not_started } kind = Kind::not_started;
    int code = 0;         // exit code, signal, or errno if it could not be started
    std::string output;   // the last 64 kB written to both streams
};

/// Runs the program without input, waits for its end and returns it. Processes of its group that still run then are killed.
ChildEnd run_child(const ChildTask& task);

/// Returns the last line of the output that is not blank, at most 300 bytes of it, made printable(); "" if there is none.
std::string last_line(const ChildEnd& end);

/// Returns "ended with exit code 3", "was killed by signal 9", "did not end in time" or "could not be started (…)", then ": " and
/// last_line(), if any.
std::string words_of(const ChildEnd& end);

/// Kills all running children and lets none start any more. For a failure elsewhere in the program: run_child() returns.
void abandon_children() noexcept;

/// Ends all running children within a second: by SIGTERM those with `tidies_up`, by SIGKILL the rest. A later run_child() never returns, as
/// the process is about to end, for example by a signal.
void end_children() noexcept;

}   // namespace meshfolio
