/// @file
/// Ending work that is no longer wanted, such as a call of the Python module after Ctrl-C.
#pragma once

#include <atomic>
#include <utility>

namespace meshfolio {

/// A request to stop: the waiting thread calls ask(), the work calls check() between its steps.
class Stop {
public:
    struct Interrupted {};
    void ask() { asked_ = true; }
    bool asked() const { return asked_; }
    /// @throws Interrupted if the stop was asked for
    void check() const {
        if (asked_) throw Interrupted{};
    }

    /// The stop that this thread's work heeds; null: none.
    static const Stop*& of_thread() {
        thread_local const Stop* stop = nullptr;
        return stop;
    }

private:
    std::atomic<bool> asked_ = false;
};

/// Makes this thread heed `stop` (null: none) during its own lifetime.
class WorkingFor {
public:
    /// @throws Stop::Interrupted if the stop was asked for
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
