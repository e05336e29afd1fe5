/// @file
/// Runs tasks that wait for other programs, as many at a time as fit into memory.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace meshfolio::run {

/// Returns the number of tasks to run in parallel, at least 1: at most `processors` and the number of tasks, and so few that the largest
/// tasks fit into memory.
/// @param memories   of each task [bytes]
/// @param available  [bytes]; 0: not known
int jobs_for(std::vector<double> memories, double available, int processors);

/// Calls task(i) for each i in order, from `jobs` threads. A task begins when its memory fits into `available` beside the tasks at work (0:
/// always), or no task is at work. Once a task throws, no other begins; the first exception is thrown again at the end.
void run_jobs(int jobs, const std::vector<double>& memories, double available, const std::function<void(std::size_t)>& task);

}   // namespace meshfolio::run
