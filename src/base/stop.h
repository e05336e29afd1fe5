/// @file
/// Work that is not wanted any more, such as that of the Python module after Ctrl-C.
#pragma once

#include <atomic>
#include <utility>

namespace meshfolio {

/// Asked for by whoever waits. Work that can end between two of its steps looks at it and throws Interrupted.
class Stop {
public:
    struct Interrupted {};
    void ask() { asked_ = true; }
    bool asked() const { return asked_; }
    void check() const {
        if (asked_) throw Interrupted{};
    }

    /// What this thread works for; null: for someone who waits for the end.
    static const Stop*& of_thread() {
        thread_local const Stop* stop = nullptr;
        return stop;
    }

private:
    std::atomic<bool> asked_ = false;
};

/// This thread works for `stop` as long as this lives. @throws Stop::Interrupted if it was asked for
class WorkingFor {
public:
    explicit WorkingFor(const Stop* stop) {
        if (stop != nullptr) stop->check();
        before_ = std::exchange(Stop::of_thread(), stop);
    }
    ~WorkingFor() { Stop::of_thread() = before_; }
    WorkingFor(const WorkingFor&) = delete;
    WorkingFor& operator=(const WorkingFor&) = delete;

private:
    const Stop* before_;
};

}   // namespace meshfolio
