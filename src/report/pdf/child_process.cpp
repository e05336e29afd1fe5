#include "report/pdf/child_process.h"

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

namespace meshfolio::report {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_output = 1 << 16, drain_step = 4096;

/// The groups that run, so that a signal can end them.
struct Registry {
    std::mutex mutex;
    std::map<pid_t, bool> groups;   // whether it tidies up
    bool abandoned = false;
};

/// Never destroyed: a signal may come while the program ends. Not on the heap: the first call may be made when no memory is left.
Registry& registry() {
    alignas(Registry) static std::byte place[sizeof(Registry)];
    static auto* const instance = ::new (place) Registry;
    return *instance;
}

/// A file descriptor that is closed when this goes.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    void close() {
        if (number_ >= 0) ::close(number_);
        number_ = -1;
    }

private:
    int number_;
};

/// As `environ`, with what is to take its place.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
    std::vector<std::string> words;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string word = *entry;
        if (!changes.contains(word.substr(0, word.find('=')))) words.push_back(word);
    }
    for (const auto& [name, value] : changes) words.push_back(name + "=" + value);
    return words;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// What the child begins with: its own group, no signal blocked or ignored, no input, both streams into `output`.
struct SpawnRules {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    SpawnRules(const ChildTask& task, int output) {
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
        posix_spawn_file_actions_addchdir_np(&files, task.folder.c_str());
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

/// @return errno, or 0 with the number of the process
int start(const ChildTask& task, int output, pid_t& process) {
    std::vector<std::string> words{task.program.string()};
    words.insert(words.end(), task.arguments.begin(), task.arguments.end());
    std::vector<std::string> environment = environment_with(task.environment);
    const SpawnRules rules(task, output);
    const std::lock_guard lock(registry().mutex);
    if (registry().abandoned) return ECANCELED;
    const int error = ::posix_spawn(&process, task.program.c_str(), &rules.files, &rules.attributes, pointers_to(words).data(),
                                    pointers_to(environment).data());
    if (error == 0) registry().groups[process] = task.tidies_up;
    return error;
}

/// Takes what there is to read. @return false at its end
bool drain(int descriptor, std::string& output) {
    char buffer[drain_step];
    for (;;) {
        const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
        if (got == 0) return false;
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        output.append(buffer, static_cast<std::size_t>(got));
        if (output.size() > 2 * most_output) output.erase(0, output.size() - most_output);
    }
}

/// It is not collected.
bool has_ended(pid_t process) {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

/// Reads along until the process itself has ended. @return false when the limit came first
bool wait_until(Clock::time_point limit, pid_t process, int output, std::string& text) {
    const Descriptor end(descriptor_of(process));
    const int most = end.number() >= 0 ? std::numeric_limits<int>::max() : 20;   // [ms], to ask again
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

}   // namespace

ChildEnd run_child(const ChildTask& task) {
    ChildEnd end;
    int pipe[2];
    if (::pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) {
        end.code = errno;
        return end;
    }
    end.output.reserve(2 * most_output + drain_step);   // nothing is thrown while the program runs
    const Descriptor reading(pipe[0]);
    Descriptor writing(pipe[1]);
    ::fcntl(writing.number(), F_SETFL, 0);   // the child's end waits for its reader
    pid_t process = 0;
    end.code = start(task, writing.number(), process);
    if (end.code != 0) return end;
    writing.close();

    const bool ended = wait_until(Clock::now() + task.limit, process, reading.number(), end.output);
    siginfo_t info{};
    if (!ended) ::kill(-process, SIGKILL);
    while (::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    }
    {
        // While the leader is not collected its number cannot be another's.
        const std::lock_guard lock(registry().mutex);
        ::kill(-process, SIGKILL);
        registry().groups.erase(process);
        ::waitpid(process, nullptr, 0);
    }
    drain(reading.number(), end.output);
    if (end.output.size() > most_output) end.output.erase(0, end.output.size() - most_output);
    end.kind = !ended ? ChildEnd::Kind::timed_out : info.si_code == CLD_EXITED ? ChildEnd::Kind::exited : ChildEnd::Kind::killed;
    end.code = info.si_status;
    return end;
}

std::string last_line(const ChildEnd& end) {
    const std::size_t last = end.output.find_last_not_of(" \n\r");
    if (last == std::string::npos) return "";
    const std::size_t before = end.output.rfind('\n', last);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    return printable(end.output.substr(first, std::min<std::size_t>(last + 1 - first, 300)));
}

std::string words_of(const ChildEnd& end) {
    std::string words;
    switch (end.kind) {
        case ChildEnd::Kind::exited:
            words = "ended with exit code " + std::to_string(end.code);
            break;
        case ChildEnd::Kind::killed:
            words = "was killed by signal " + std::to_string(end.code);
            break;
        case ChildEnd::Kind::timed_out:
            words = "did not end in time";
            break;
        case ChildEnd::Kind::not_started:
            words = std::string("could not be started (") + std::strerror(end.code) + ")";
            break;
    }
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
    registry().mutex.lock();   // and never unlocked
    for (const auto& [group, tidies_up] : registry().groups) ::kill(-group, tidies_up ? SIGTERM : SIGKILL);
    const auto all_have_ended = [] {
        return std::ranges::all_of(registry().groups, [](const auto& group) { return has_ended(group.first); });
    };
    for (auto waited = pause; waited < most && !all_have_ended(); waited += pause) std::this_thread::sleep_for(pause);
    for (const auto& [group, tidies_up] : registry().groups) ::kill(-group, SIGKILL);
}

}   // namespace meshfolio::report
