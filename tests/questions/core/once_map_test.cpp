#include "questions/core/mesh_library.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel_tasks.h"

namespace meshfolio {

TEST(OnceMap, MakesEachValueOnceForAllThreads) {
    OnceMap map;
    std::atomic<int> made = 0;
    for_each_task(64, [&](std::size_t i) {
        const std::string key = std::to_string(i % 4);
        const auto make = [&] {
            ++made;
            std::atomic<int> inside = 0;
            for_each_task(16, [&](std::size_t) { ++inside; });   // a loop inside takes none of the waiting tasks
            return key + "!";
        };
        EXPECT_EQ(map.value(key, make), key + "!");
    });
    EXPECT_EQ(made, 4);
    EXPECT_EQ(&map.value("0", [] { return std::string(); }), &map.value("0", [] { return std::string(); }));
}

TEST(OnceMap, WaitsForTheSameKeyOnly) {
    OnceMap map;
    std::latch begun(1), end(1);
    std::jthread slow([&] {
        map.value("slow", [&] {
            begun.count_down();
            end.wait();
            return 1;
        });
    });
    begun.wait();
    EXPECT_EQ(map.value("fast", [] { return 2; }), 2);
    end.count_down();
    EXPECT_EQ(map.value("slow", [] { return 3; }), 1);
}

TEST(OnceMap, ThrowsAFailureToAllThatWaitAndTriesAgain) {
    OnceMap map;
    std::latch begun(1);
    std::atomic<int> waiting = 0, failures = 0;
    const auto fail = [&]() -> int {
        begun.count_down();
        while (waiting < 3) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        throw std::runtime_error("made to fail");
    };
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&, i] {
                if (i > 0) begun.wait(), ++waiting;
                try {
                    map.value("key", [&]() -> int { return i == 0 ? fail() : 7; });
                } catch (const std::runtime_error&) {
                    ++failures;
                }
            });
    }
    EXPECT_EQ(failures, 4);
    EXPECT_EQ(map.value("key", [] { return 7; }), 7);
}

}   // namespace meshfolio
