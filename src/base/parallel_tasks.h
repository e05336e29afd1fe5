/// @file
/// Large tasks in parallel, which may contain parallel loops (parallel.h).
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <cstddef>

#include "base/first_failure.h"
#include "base/stop.h"

namespace meshfolio {

/// Calls task(0) … task(count − 1) on all processors. If a task throws, tasks in progress go on, tasks not yet begun are skipped, and the
/// first exception is thrown again at the end. The Stop of the calling thread is checked before each task. (An exception that left oneTBB's
/// loop would cancel the loops inside the other tasks, which would then return early as if they were done.)
template <class Task>
void for_each_task(std::size_t count, const Task& task) {
    FirstFailure failure;
    const auto guarded = [&, stop = Stop::of_thread()](std::size_t i) {
        failure.guard([&] {
            const WorkingFor working(stop);
            task(i);
        });
    };
    tbb::parallel_for(std::size_t{0}, count, guarded, tbb::simple_partitioner());
    failure.rethrow();
}

/// Calls each task() in parallel, with exceptions treated as by for_each_task().
template <class... Tasks>
void run_tasks(const Tasks&... tasks) {
    FirstFailure failure;
    tbb::parallel_invoke([&] { failure.guard(tasks); }...);
    failure.rethrow();
}

}   // namespace meshfolio
