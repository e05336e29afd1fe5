/// @file
/// Long work as Python wants it: without its lock, and ended by Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <utility>

namespace meshfolio::python {

/// Asked for by Ctrl-C. Work that can end between two of its steps looks at it and throws Interrupted.
class Stop {
public:
    struct Interrupted {};
    void ask() { asked_ = true; }
    bool asked() const { return asked_; }
    void check() const {
        if (asked_) throw Interrupted{};
    }

private:
    std::atomic<bool> asked_ = false;
};

inline std::atomic<int> works_running = 0;

/// work(stop) in a thread of its own, while this one listens to signals. On Ctrl-C the work is told to stop and left to itself, so it must
/// own all it needs, and no object of Python. @throws what the work throws, or KeyboardInterrupt
template <class Work>
auto interruptible(Work work) {
    using Result = decltype(work(std::declval<const Stop&>()));
    const auto stop = std::make_shared<Stop>();
    std::packaged_task<Result()> task([work = std::move(work), stop]() mutable { return work(*stop); });
    std::future<Result> result = task.get_future();
    std::thread([task = std::move(task)]() mutable {
        std::exchange(task, {})();
        --works_running;
    }).detach();
    ++works_running;
    for (bool done = false; !done;) {
        {
            const pybind11::gil_scoped_release released;
            done = result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
        }
        if (!done && PyErr_CheckSignals() != 0) {
            stop->ask();
            throw pybind11::error_already_set();
        }
    }
    return result.get();
}

/// What was left to itself must have ended before the process takes its ground away.
inline void wait_for_works() {
    const pybind11::gil_scoped_release released;
    while (works_running > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

}   // namespace meshfolio::python
