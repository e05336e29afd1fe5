/// @file
/// Large tasks side by side, which have loops of their own inside; parallel.h has the loops.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <cstddef>

#include "base/first_failure.h"
#include "base/stop.h"

namespace meshfolio {

/// task(0) … task(count − 1) on all processors, handed out one by one. What a task throws must not leave oneTBB's loop: the loops inside
/// the other tasks would be cancelled with it, and return early as if they were done. Here they go on, tasks not yet begun are left out,
/// and what was thrown first is thrown again at the end. Between two tasks the whole can be stopped.
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

/// The same for tasks of different kinds.
template <class... Tasks>
void run_tasks(const Tasks&... tasks) {
    FirstFailure failure;
    tbb::parallel_invoke([&] { failure.guard(tasks); }...);
    failure.rethrow();
}

}   // namespace meshfolio
