/// @file
/// Long work for Python: without the GIL, and stopped by Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include "base/parallel_tasks.h"

namespace meshfolio::python {

inline std::atomic<int> works_running = 0;

/// Makes the process exit without destructors, and without waiting, if abandoned work still computes at its end: destructors could crash
/// it.
inline void leave_works_at_exit() {
#ifdef __GLIBC__
    ::on_exit(
        [](int status, void*) {
            if (works_running == 0) return;
            std::fflush(nullptr);
            ::_exit(status);
        },
        nullptr);
#else   // the function is not told the status
    std::atexit([] {
        while (works_running > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    });
#endif
}

/// Returns work(stop), run in a thread of its own while this thread listens to signals. After Ctrl-C the work is asked to stop and
/// abandoned, so it must own all its data and no Python object. @throws what the work throws, or KeyboardInterrupt
template <class Work> auto interruptible(Work work) {
    using Result = decltype(work(std::declval<const Stop&>()));
    const auto stop = std::make_shared<Stop>();
    std::packaged_task<Result()> task([work = std::move(work), stop]() mutable {
        const ThreadStop working(stop.get());
        return work(*stop);
    });
    std::future<Result> result = task.get_future();
    ++works_running;
    std::thread([task = std::move(task)]() mutable {
        std::exchange(task, {})();
        --works_running;
    }).detach();
    for (bool done = false; !done;) {
        {
            const pybind11::gil_scoped_release released;
            done = result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
        }
        if (!done && PyErr_CheckSignals() != 0) {
            stop->ask();
            leave_works_at_exit();   // again: it must run before exit functions that the work has registered meanwhile
            throw pybind11::error_already_set();
        }
    }
    return result.get();
}

}   // namespace meshfolio::python
