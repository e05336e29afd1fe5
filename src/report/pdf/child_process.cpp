#include "report/pdf/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
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
#include "report/pdf/spawn.h"

namespace meshfolio::report {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_output = 1 << 16, step = 1 << 16;   // [bytes]
constexpr std::size_t most_heard = 1 << 28;                    // [bytes] of one message

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

/// @return errno, or 0 with the number of the process
int start(const ChildTask& task, int output, int channel, pid_t& process) {
    const std::lock_guard lock(registry().mutex);
    if (registry().abandoned) return ECANCELED;
    const int error = spawn(task, output, channel, process);
    if (error == 0) registry().groups[process] = task.tidies_up;
    return error;
}

/// Takes what there is to read, but no more at once than leaves the caller time for its limits; twice `most` of it are kept.
/// @return false at its end
bool drain(int descriptor, std::string& text, std::size_t most = most_output) {
    char buffer[step];
    for (int round = 0; round < 16; ++round) {
        const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
        if (got == 0) return false;
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        text.append(buffer, static_cast<std::size_t>(got));
        if (text.size() / 2 > most) text.erase(0, text.size() - most);
    }
    return true;
}

/// What is said with a child. It is over when all is said, or when a message has no end.
class Conversation {
public:
    Conversation(const ChildTask& task, int channel) : answer_(task.answer), channel_(channel) {
        if (channel_ >= 0) say("");
    }
    bool is_over() const { return is_over_; }
    pollfd watched() const { return {is_open_ ? channel_ : -1, static_cast<short>(unsent_.empty() ? POLLIN : POLLIN | POLLOUT), 0}; }
    void go_on() {
        send();
        is_open_ = drain(channel_, heard_, std::string::npos);
        std::size_t begin = 0;
        for (std::size_t end; !is_over_ && (end = heard_.find('\0', std::max(begin, searched_))) != std::string::npos; begin = end + 1)
            say(std::string_view(heard_).substr(begin, end - begin));
        heard_.erase(0, begin);
        searched_ = heard_.size();
        is_over_ = is_over_ || heard_.size() > most_heard;
    }

private:
    const std::function<std::optional<std::string>(std::string_view)>& answer_;
    int channel_;
    bool is_open_ = true, is_over_ = false;
    std::string heard_, unsent_;
    std::size_t searched_ = 0;   // no message ends before

    void say(std::string_view message) {
        const std::optional<std::string> words = answer_(message);
        is_over_ = !words;
        if (!words || words->empty()) return;
        unsent_.append(*words).push_back('\0');
        send();
    }
    void send() {
        const ssize_t sent = ::send(channel_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
        if (sent > 0) unsent_.erase(0, static_cast<std::size_t>(sent));
        if (sent < 0 && errno != EAGAIN && errno != EINTR) unsent_.clear();   // nobody hears it
    }
};

/// It is not collected.
bool has_ended(pid_t process) {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

/// Reads along until the process itself has ended or all is said. @return false when the limit came first
bool wait_until(Clock::time_point limit, pid_t process, int output, std::string& text, Conversation& conversation) {
    const Descriptor end(descriptor_of(process));
    const int most = end.number() >= 0 ? std::numeric_limits<int>::max() : 20;   // [ms], to ask again
    bool open = true;
    for (;;) {
        pollfd watched[3] = {{end.number(), POLLIN, 0}, {open ? output : -1, POLLIN, 0}, conversation.watched()};
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now()).count();
        if (left <= 0) return false;
        if (::poll(watched, 3, static_cast<int>(std::min<std::int64_t>(left, most))) < 0 && errno != EINTR) return false;
        if (watched[1].revents != 0) open = drain(output, text);
        if (watched[2].revents != 0) conversation.go_on();
        if (conversation.is_over()) return true;
        if (watched[0].revents != 0 || (end.number() < 0 && has_ended(process))) return true;
    }
}

/// A child that runs. In the end its group is killed, and it is collected.
class Running {
public:
    explicit Running(pid_t process) : process_(process) {}
    ~Running() {
        {
            // While the leader is not collected its number cannot be another's.
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

/// Until all processes of a killed group have closed it, and write no more files either. One that has left the group is not waited for.
void await_end_of(int output, std::string& text) {
    const auto limit = Clock::now() + std::chrono::seconds(2);
    pollfd watched{output, POLLIN, 0};
    while (Clock::now() < limit && ::poll(&watched, 1, 1000) > 0 && drain(output, text)) {
    }
}

}   // namespace

ChildEnd run_child(const ChildTask& task) {
    ChildEnd end;
    int pipe[2], channel[2] = {-1, -1};
    if (::pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) {
        end.code = errno;
        return end;
    }
    const Descriptor reading(pipe[0]);
    Descriptor writing(pipe[1]);
    ::fcntl(writing.number(), F_SETFL, 0);   // the child's end waits for its reader
    if (task.answer && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channel) != 0) {
        end.code = errno;
        return end;
    }
    const Descriptor ours(channel[0]);
    Descriptor theirs(channel[1]);
    if (task.answer) ::fcntl(ours.number(), F_SETFL, O_NONBLOCK);
    pid_t process = 0;
    end.code = start(task, writing.number(), theirs.number(), process);
    if (end.code != 0) return end;
    bool ended = false, dismissed = false;
    siginfo_t info{};
    {
        const Running running(process);
        writing.close();
        theirs.close();
        Conversation conversation(task, ours.number());
        ended = wait_until(Clock::now() + task.limit, process, reading.number(), end.output, conversation);
        dismissed = conversation.is_over();
        if (!ended || dismissed) ::kill(-process, SIGKILL);
        while (::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
        }
    }
    if (dismissed) await_end_of(reading.number(), end.output);
    drain(reading.number(), end.output);
    if (end.output.size() > most_output) end.output.erase(0, end.output.size() - most_output);
    end.kind = !ended                       ? ChildEnd::Kind::timed_out
               : dismissed                  ? ChildEnd::Kind::dismissed
               : info.si_code == CLD_EXITED ? ChildEnd::Kind::exited
                                            : ChildEnd::Kind::killed;
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
        case ChildEnd::Kind::dismissed:
            words = "gave no usable answer";
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
