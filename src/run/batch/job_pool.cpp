#include "run/batch/job_pool.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/parallel_tasks.h"

namespace meshfolio::run {

int jobs_for(std::vector<double> memories, double available, int processors) {
    std::ranges::sort(memories, std::greater());
    const std::size_t most = std::min(memories.size(), static_cast<std::size_t>(std::max(1, processors)));
    std::size_t jobs = 0;
    for (double sum = 0; jobs < most; ++jobs) {
        sum += memories[jobs];
        if (available > 0 && sum > available) break;
    }
    return static_cast<int>(std::max<std::size_t>(1, jobs));
}

void run_jobs(int jobs, const std::vector<double>& memories, double available, const std::function<void(std::size_t)>& task) {
    FirstFailure failure;
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t next = 0;
    int at_work = 0;
    double used = 0;
    const auto may_go_on = [&] { return next == memories.size() || at_work == 0 || available <= 0 || used + memories[next] <= available; };
    const auto work = [&] {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, may_go_on);
            if (next == memories.size()) return;
            const std::size_t i = next++;
            ++at_work;
            used += memories[i];
            lock.unlock();
            failure.guard([&] { task(i); });
            lock.lock();
            --at_work;
            used -= memories[i];
            changed.notify_all();
        }
    };
    {
        std::vector<std::jthread> threads;   // waited for at the end
        for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
    }
    failure.rethrow();
}

}   // namespace meshfolio::run
