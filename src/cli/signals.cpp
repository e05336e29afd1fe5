#include "cli/cli.h"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/child_process.h"
#include "base/errors.h"
#include "base/linux_only.h"
#include "output/publish/temporaries.h"

namespace meshfolio::cli {

namespace {

void fill_closed_descriptors() {
    for (int descriptor = 0; descriptor <= 2; ++descriptor) {
        if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
        // open() takes the lowest free number, which is this one. Only for reading, so that writing fails.
        if (::open("/dev/null", O_RDONLY) < 0 && ::open("/", O_RDONLY | O_DIRECTORY) < 0) return;
    }
}

sigset_t ending_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
    struct sigaction hangup {};
    if (::sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler == SIG_IGN) sigdelset(&set, SIGHUP);   // under nohup
    return set;
}

/// Prints to stderr without blocking: a full pipe must not keep the process alive.
void tell(std::string_view message) {
    pollfd ready{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&ready, 1, 0) != 1) return;
    if (::write(STDERR_FILENO, message.data(), message.size()) < 0) {
        // There is no place to report this.
    }
}

/// Waits for a signal, cleans up and ends the process. Runs in a thread of its own, which may call what a signal handler may not.
[[noreturn]] void wait_for_the_end(sigset_t signals) {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    end_children();
    const bool has_published = output::abandon_publications();
    if (::isatty(STDERR_FILENO)) tell("\n");   // leaves the line of progress
    tell(has_published ? "meshfolio: interrupted; what was finished before is in its place\n"
                       : "meshfolio: interrupted; the earlier output is as it was\n");
    ::_exit(128 + signal);
}

pthread_t ending_thread;   // waits in wait_for_the_end()

/// Forwards a signal to the waiting thread: threads that a library started before main() do not block signals and may receive them.
void hand_on(int signal) { pthread_kill(ending_thread, signal); }

/// Cleans up after an uncaught exception: destructors of libraries may run out of memory although they must not throw.
[[noreturn]] void end_after_uncaught() {
    try {
        if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
        tell("meshfolio: internal error: terminated\n");
    } catch (const std::bad_alloc&) {
        tell("meshfolio: out of memory\n");
    } catch (...) {
        tell("meshfolio: internal error: an exception was not caught\n");
    }
    end_children();
    output::abandon_publications();
    ::_exit(static_cast<int>(ExitCode::failed));
}

/// Ends this run when the batch run that started it ends, even if that was killed.
void end_with_parent() {
    const char* parent = std::getenv("MESHFOLIO_PARENT");
    if (parent == nullptr) return;
    ask_for_signal_of_parent(SIGTERM);
    if (std::to_string(::getppid()) != parent) ::_exit(128 + SIGTERM);   // it has ended before
}

[[noreturn]] void end_before_begin() {
    tell("meshfolio: out of memory; the program could not begin\n");
    ::_exit(static_cast<int>(ExitCode::failed));
}

/// Requires memory for loading the libraries: some crash, or throw outside any handler, without it.
__attribute__((no_sanitize("address", "thread", "undefined"))) void require_room_to_begin() {
    constexpr std::size_t room = std::size_t{8} << 20;   // less than any command needs
    std::set_terminate(end_before_begin);                // until prepare_process()
    void* const probe = ::mmap(nullptr, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (probe == MAP_FAILED) end_before_begin();
    ::munmap(probe, room);
}

MESHFOLIO_BEFORE_LIBRARIES void (*const at_the_very_beginning)() = require_room_to_begin;

}   // namespace

void prepare_process() {
#ifdef __GLIBC__
    // Matrices of large meshes are allocated by the hundred: keeping their pages saves the system from clearing new ones each time.
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);   // the largest value allowed
    ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
    end_with_parent();
    fill_closed_descriptors();
    std::set_terminate(end_after_uncaught);
    for (const int ignored : {SIGPIPE, SIGXFSZ}) static_cast<void>(::signal(ignored, SIG_IGN));   // such a write fails instead
    const sigset_t signals = ending_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    try {
        std::thread waiting(wait_for_the_end, signals);
        ending_thread = waiting.native_handle();
        waiting.detach();
        struct sigaction action {};
        action.sa_handler = hand_on;
        action.sa_flags = SA_RESTART;
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            if (sigismember(&signals, signal) == 1) ::sigaction(signal, &action, nullptr);
    } catch (const std::system_error&) {   // no memory for a thread: signals end the process without cleaning up
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    }
}

void end_by_broken_pipe() {
    static_cast<void>(::signal(SIGPIPE, SIG_DFL));
    static_cast<void>(::raise(SIGPIPE));
    ::_exit(128 + SIGPIPE);   // it was blocked
}

}   // namespace meshfolio::cli
