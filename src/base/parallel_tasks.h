/// @file
/// Large tasks in parallel, which may contain parallel loops (parallel.h): their first failure, and their end on request.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <utility>

namespace meshfolio {

/// Keeps the first exception of parallel pieces of work and skips the pieces not yet begun.
class FirstFailure {
public:
    struct OtherFailed {};

    /// Returns if no work has failed; to be called within work, so that it ends early. @throws OtherFailed if other work has failed
    void check() const {
        if (happened_) throw OtherFailed();
    }
    /// Calls work() and keeps what it throws, unless other work has failed before. May be called from several threads at once.
    template <class Work> void guard(const Work& work) {
        if (happened_) return;
        try {
            work();
        } catch (const OtherFailed&) {   // the first failure is kept already
        } catch (...) {
            if (!happened_.exchange(true)) exception_ = std::current_exception();
        }
    }
    /// Throws the first exception again, if there is one; to be called when all work has ended.
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

private:
    std::atomic<bool> happened_ = false;
    std::exception_ptr exception_;
};

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
class ThreadStop {
public:
    /// @throws Stop::Interrupted if the stop was asked for
    explicit ThreadStop(const Stop* stop) {
        if (stop != nullptr) stop->check();
        before_ = std::exchange(Stop::of_thread(), stop);
    }
    ~ThreadStop() { Stop::of_thread() = before_; }
    ThreadStop(const ThreadStop&) = delete;
    ThreadStop& operator=(const ThreadStop&) = delete;

private:
    const Stop* before_;
};

/// Calls task(0) … task(count − 1) on all processors. If a task throws, tasks in progress go on, tasks not yet begun are skipped, and the
/// first exception is thrown again at the end. The Stop of the calling thread is checked before each task. (An exception that left oneTBB's
/// loop would cancel the loops inside the other tasks, which would then return early as if they were done.)
template <class Task> void for_each_task(std::size_t count, const Task& task) {
    FirstFailure failure;
    const auto guarded = [&, stop = Stop::of_thread()](std::size_t i) {
        failure.guard([&] {
            const ThreadStop working(stop);
            task(i);
        });
    };
    tbb::parallel_for(std::size_t{0}, count, guarded, tbb::simple_partitioner());
    failure.rethrow();
}

/// Calls each task() in parallel, with exceptions treated as by for_each_task().
template <class... Tasks> void run_tasks(const Tasks&... tasks) {
    FirstFailure failure;
    tbb::parallel_invoke([&] { failure.guard(tasks); }...);
    failure.rethrow();
}

}   // namespace meshfolio
