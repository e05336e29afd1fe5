#include "run/batch/job_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "run/batch/report_run.h"

namespace meshfolio::run {
namespace {

TEST(Jobs, AsManyAsCoresTasksAndMemoryAllow) {
    EXPECT_EQ(jobs_for({1, 1, 1}, 0, 8), 3);
    EXPECT_EQ(jobs_for({1, 1, 1}, 10, 2), 2);
    EXPECT_EQ(jobs_for({1, 5, 4}, 9.5, 8), 2);
    EXPECT_EQ(jobs_for({1, 5, 4}, 3, 8), 1);   // one is always tried
    EXPECT_EQ(jobs_for({}, 3, 8), 1);
    EXPECT_EQ(jobs_for({1}, 3, 0), 1);
}

TEST(Jobs, EachIsDoneOnceAndThoseAtWorkFitIntoTheMemory) {
    const std::vector<double> memories{3, 1, 9, 2, 2, 1, 1, 3};   // the third alone is too much, and is done alone
    std::mutex mutex;
    std::set<std::size_t> at_work, done;
    run_jobs(4, memories, 5, [&](std::size_t i) {
        {
            const std::lock_guard lock(mutex);
            at_work.insert(i);
            double sum = 0;
            for (const std::size_t k : at_work) sum += memories[k];
            EXPECT_TRUE(sum <= 5 || at_work.size() == 1) << i;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        const std::lock_guard lock(mutex);
        at_work.erase(i);
        EXPECT_TRUE(done.insert(i).second);
    });
    EXPECT_EQ(done.size(), memories.size());
}

TEST(Jobs, AFailureEndsTheOthersAndIsThrown) {
    std::atomic<int> begun = 0;
    EXPECT_THROW(run_jobs(1, std::vector<double>(50, 1), 0,
                          [&](std::size_t) {
                              ++begun;
                              throw std::runtime_error("disk full");
                          }),
                 std::runtime_error);
    EXPECT_EQ(begun, 1);
    run_jobs(0, {}, 0, [](std::size_t) { FAIL(); });
}

TEST(ReportRuns, WordsAreThoseOfTheBatch) {
    BatchFlags flags;
    flags.report.out = "reports";
    flags.report.author = "-x";
    flags.report.quick = true;
    const std::vector<std::string> words = report_words(flags, {"-a.obj", "_a"}, {"--threads=2"});
    EXPECT_EQ(words, (std::vector<std::string>{"report", "./-a.obj", "--out=reports/_a", "--author=-x", "--quick", "--threads=2"}));
}

TEST(ReportRuns, APlanIsFoundBehindWarnings) {
    const std::string plan = "{\n  \"sections\": [{\"id\": \"q2\", \"meshes\": []}, {\"meshes\": [{\"vertices\": 12.5}]}]\n}\n";
    EXPECT_EQ(planned_vertices(plan), 12.5);
    EXPECT_EQ(planned_vertices("meshfolio: warning: {odd}\n" + plan), 12.5);
    EXPECT_EQ(planned_vertices("{\n\"sections\": []}"), 0.0);
    for (const char* other : {"", "meshfolio: a.obj:3: no triangle", "{\n", "{\n}", "{\n\"sections\": [{\"meshes\": [{}]"})
        EXPECT_FALSE(planned_vertices(other).has_value()) << other;
}

TEST(ReportRuns, AFailureIsOneLine) {
    ChildEnd end{ChildEnd::Kind::exited, 3, "first\nmeshfolio: a.obj:3: no triangle\n"};
    EXPECT_EQ(failure_of(end), "a.obj:3: no triangle");
    end = {ChildEnd::Kind::killed, 9, "meshfolio: q4\n"};
    EXPECT_NE(failure_of(end).find("killed by signal 9"), std::string::npos);
}

}   // namespace
}   // namespace meshfolio::run
