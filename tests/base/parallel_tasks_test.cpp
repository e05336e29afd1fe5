#include "base/parallel_tasks.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace meshfolio;

namespace {

/// Two tasks at once: one fails while the other is within a loop. @return  iterations of that loop, after it has returned
int iterations_beside_a_failure(int iterations) {
    std::atomic<bool> is_within = false, has_failed = false;
    std::atomic<int> done = 0;
    int counted = 0;
    const auto wait_for = [](const std::atomic<bool>& flag) {
        for (int i = 0; i < 400 && !flag; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    };
    const auto failing = [&] {
        wait_for(is_within);
        has_failed = true;
        throw std::runtime_error("failed");
    };
    const auto looping = [&] {
        tbb::parallel_for(0, iterations, [&](int) {
            is_within = true;
            wait_for(has_failed);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));   // what has failed is being told
            ++done;
        });
        counted = done;
    };
    EXPECT_THROW(run_tasks(looping, failing), std::runtime_error);
    return counted;
}

}   // namespace

TEST(ParallelTasks, EachTaskRunsOnce) {
    std::vector<int> times(1000, 0);
    for_each_task(times.size(), [&](std::size_t i) { ++times[i]; });
    EXPECT_EQ(std::accumulate(times.begin(), times.end(), 0), 1000);
    EXPECT_EQ(*std::max_element(times.begin(), times.end()), 1);
    for_each_task(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelTasks, AFailureDoesNotCutOffTheLoopsOfOtherTasks) {
    tbb::task_arena two(2);
    const int counted = two.execute([] { return iterations_beside_a_failure(200); });
    EXPECT_TRUE(counted == 200 || counted == 0) << counted;   // 0: one after the other, where there is one processor
}

TEST(ParallelTasks, TheFirstFailureIsThrownAndEndsTheRest) {
    std::atomic<int> begun = 0;
    const auto fails = [&](std::size_t) {
        ++begun;
        throw std::runtime_error("first");
    };
    EXPECT_THROW(for_each_task(10000, fails), std::runtime_error);
    EXPECT_LT(begun, 1000);
}

TEST(ParallelTasks, AStopEndsTheTasksOfItsThreadAlone) {
    Stop stop;
    std::atomic<int> begun = 0;
    const auto asks = [&](std::size_t) {
        ++begun;
        stop.ask();
    };
    {
        const ThreadStop working(&stop);
        EXPECT_THROW(for_each_task(10000, asks), Stop::Interrupted);
        EXPECT_LT(begun, 1000);
        EXPECT_THROW(ThreadStop again(&stop), Stop::Interrupted);
    }
    begun = 0;
    for_each_task(100, asks);   // for nobody
    EXPECT_EQ(begun, 100);
}
