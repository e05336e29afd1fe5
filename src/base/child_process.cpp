#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <new>
#include <thread>

#include "base/errors.h"
#include "base/linux_only.h"

extern char** environ;

namespace meshfolio {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_output = 1 << 16;   // [bytes]

/// The running process groups, which a signal has to end.
struct Registry {
    std::mutex mutex;
    std::map<pid_t, bool> groups;   // true: tidies up
    bool abandoned = false;
};

/// Returns the registry of this process. It is never destroyed, as a signal may come while the program ends, and not on the heap, as the
/// first call may come when no memory is left.
Registry& registry() {
    alignas(Registry) static std::byte place[sizeof(Registry)];
    static auto* const instance = ::new (place) Registry;
    return *instance;
}

/// A file descriptor, closed by the destructor.
class FileDescriptor {
public:
    explicit FileDescriptor(int number) : number_(number) {}
    ~FileDescriptor() { close(); }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    int number() const { return number_; }
    void close() {
        if (number_ >= 0) ::close(number_);
        number_ = -1;
    }

private:
    int number_;
};

/// Attributes of a new child: a process group of its own, no signal blocked or ignored, no input, and both streams into `output`.
struct SpawnRules {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    SpawnRules(const std::filesystem::path& folder, int output) {
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
        posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
        posix_spawnattr_init(&attributes);
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnRules() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnRules(const SpawnRules&) = delete;
    SpawnRules& operator=(const SpawnRules&) = delete;
};

std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Starts the program and enters its group in the registry.
/// @return 0, with its number in `process`, or errno
int start(const ChildTask& task, int output, pid_t& process) {
    std::vector<std::string> words{task.program.string()}, environment;
    words.insert(words.end(), task.arguments.begin(), task.arguments.end());
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string variable = *entry;
        if (!task.environment.contains(variable.substr(0, variable.find('=')))) environment.push_back(variable);
    }
    for (const auto& [name, value] : task.environment) environment.push_back(name + "=" + value);
    const SpawnRules rules(task.folder, output);

    const std::lock_guard lock(registry().mutex);
    if (registry().abandoned) return ECANCELED;
    const int error = ::posix_spawn(&process, task.program.c_str(), &rules.files, &rules.attributes, pointers_to(words).data(),
                                    pointers_to(environment).data());
    if (error == 0) registry().groups[process] = task.tidies_up;
    return error;
}

/// Appends the bytes that can be read now to `text` and drops its beginning where it is too long. Reads 1 MB at most, so that the caller
/// can watch its limits.
/// @return false at the end of the stream
bool drain(int descriptor, std::string& text) {
    char buffer[1 << 16];
    for (int round = 0; round < 16; ++round) {
        const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
        if (got == 0) return false;
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        text.append(buffer, static_cast<std::size_t>(got));
        if (text.size() > most_output) text.erase(0, text.size() - most_output);
    }
    return true;
}

/// True once the process has ended. Leaves it to be collected.
bool has_ended(pid_t process) {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

/// Reads the output until the process itself has ended.
/// @return false if the limit came first
bool wait_until(Clock::time_point limit, pid_t process, int output, std::string& text) {
    const FileDescriptor end(descriptor_of(process));
    const int most = end.number() >= 0 ? std::numeric_limits<int>::max() : 20;   // [ms] between two looks
    bool open = true;
    for (;;) {
        pollfd watched[2] = {{end.number(), POLLIN, 0}, {open ? output : -1, POLLIN, 0}};
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now()).count();
        if (left <= 0) return false;
        if (::poll(watched, 2, static_cast<int>(std::min<std::int64_t>(left, most))) < 0 && errno != EINTR) return false;
        if (watched[1].revents != 0) open = drain(output, text);
        if (watched[0].revents != 0 || (end.number() < 0 && has_ended(process))) return true;
    }
}

/// A running child. The destructor kills its group and collects it.
class Running {
public:
    explicit Running(pid_t process) : process_(process) {}
    ~Running() {
        {
            // Until the leader is collected, its number belongs to no other process.
            const std::lock_guard lock(registry().mutex);
            ::kill(-process_, SIGKILL);
            registry().groups.erase(process_);
        }
        while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

private:
    pid_t process_;
};

}   // namespace

ChildEnd run_child(const ChildTask& task) {
    ChildEnd end;
    int pipe[2];
    if (::pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) {
        end.code = errno;
        return end;
    }
    const FileDescriptor reading(pipe[0]);
    FileDescriptor writing(pipe[1]);
    ::fcntl(writing.number(), F_SETFL, 0);   // the child blocks where the pipe is full
    pid_t process = 0;
    end.code = start(task, writing.number(), process);
    if (end.code != 0) return end;
    bool ended = false;
    siginfo_t info{};
    {
        const Running running(process);
        writing.close();
        ended = wait_until(Clock::now() + task.limit, process, reading.number(), end.output);
        if (!ended) ::kill(-process, SIGKILL);
        while (::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
        }
    }
    drain(reading.number(), end.output);
    end.kind = !ended ? ChildEnd::Kind::timed_out : info.si_code == CLD_EXITED ? ChildEnd::Kind::exited : ChildEnd::Kind::killed;
    end.code = info.si_status;
    return end;
}

std::string last_line(const ChildEnd& end) {
    const std::size_t last = end.output.find_last_not_of(" \n\r");
    if (last == std::string::npos) return "";
    const std::size_t first = end.output.rfind('\n', last) + 1;   // 0 without a line end
    return printable(end.output.substr(first, std::min<std::size_t>(last + 1 - first, 300)));
}

std::string words_of(const ChildEnd& end) {
    using Kind = ChildEnd::Kind;
    const std::string words = end.kind == Kind::exited      ? "ended with exit code " + std::to_string(end.code)
                              : end.kind == Kind::killed    ? "was killed by signal " + std::to_string(end.code)
                              : end.kind == Kind::timed_out ? "did not end in time"
                                                            : std::string("could not be started (") + std::strerror(end.code) + ")";
    const std::string line = last_line(end);
    return line.empty() ? words : words + ": " + line;
}

void abandon_children() noexcept {
    const std::lock_guard lock(registry().mutex);
    registry().abandoned = true;
    for (const auto& [group, unused] : registry().groups) ::kill(-group, SIGKILL);
}

void end_children() noexcept {
    constexpr auto pause = std::chrono::milliseconds(10), most = std::chrono::milliseconds(700);
    registry().mutex.lock();   // and never unlocked: no child starts any more
    for (const auto& [group, tidies_up] : registry().groups) ::kill(-group, tidies_up ? SIGTERM : SIGKILL);
    const auto all_have_ended = [] {
        return std::ranges::all_of(registry().groups, [](const auto& group) { return has_ended(group.first); });
    };
    for (auto waited = pause; waited < most && !all_have_ended(); waited += pause) std::this_thread::sleep_for(pause);
    for (const auto& [group, tidies_up] : registry().groups) ::kill(-group, SIGKILL);
}

}   // namespace meshfolio
