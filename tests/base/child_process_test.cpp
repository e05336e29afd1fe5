#include "base/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <iterator>
#include <thread>

namespace meshfolio {
namespace {

ChildEnd shell(const std::string& script, std::chrono::milliseconds limit = std::chrono::seconds(60)) {
    return run_child({"/bin/sh", {"-c", script}, {{"GREETING", "hello"}}, "/", limit});
}

TEST(ChildProcess, ReportsTheExitCodeAndKeepsBothStreams) {
    const ChildEnd end = shell("echo out; echo \"$GREETING\" >&2; pwd; exit 3");
    EXPECT_EQ(end.kind, ChildEnd::Kind::exited);
    EXPECT_EQ(end.code, 3);
    EXPECT_EQ(end.output, "out\nhello\n/\n");
    EXPECT_EQ(words_of(end), "ended with exit code 3: /");
}

TEST(ChildProcess, ReportsACrash) {
    const ChildEnd end = shell("echo gone wrong >&2; kill -SEGV $$");
    EXPECT_EQ(end.kind, ChildEnd::Kind::killed);
    EXPECT_EQ(end.code, SIGSEGV);
    EXPECT_EQ(words_of(end), "was killed by signal 11: gone wrong");
}

TEST(ChildProcess, ReportsAMissingProgram) {
    const ChildEnd end = run_child({"/nonexistent/program", {}, {}});
    EXPECT_EQ(end.kind, ChildEnd::Kind::not_started);
    EXPECT_NE(words_of(end).find("could not be started"), std::string::npos);
}

TEST(ChildProcess, KillsTheWholeGroupAtTheLimit) {
    const auto began = std::chrono::steady_clock::now();
    // The grandchild holds the streams open.
    const ChildEnd end = shell("sleep 300 & echo $!; wait", std::chrono::milliseconds(700));
    EXPECT_EQ(end.kind, ChildEnd::Kind::timed_out);
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(60));
    const pid_t grandchild = std::stoi(end.output);
    for (int i = 0; i < 200 && ::kill(grandchild, 0) == 0; ++i) {
        // Its new parent collects it; a zombie has no command line.
        std::ifstream file("/proc/" + std::to_string(grandchild) + "/cmdline");
        if (std::string((std::istreambuf_iterator<char>(file)), {}).empty()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_NE(::kill(grandchild, 0), 0);
}

TEST(ChildProcess, DoesNotWaitForProcessesThatTheProgramLeavesBehind) {
    const auto began = std::chrono::steady_clock::now();
    EXPECT_EQ(shell("sleep 300 & exit 0").kind, ChildEnd::Kind::exited);
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(60));
}

TEST(ChildProcess, AbandoningKillsThoseThatRunAndStartsNoMore) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");   // a process of its own, as no test after it could start a child
    const auto abandoned = [] {
        ChildEnd end;
        std::thread waiting([&] { end = shell("sleep 300"); });
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        abandon_children();
        waiting.join();
        const bool ended = end.kind == ChildEnd::Kind::killed || end.kind == ChildEnd::Kind::not_started;   // slow machines
        return ended && shell("exit 0").kind == ChildEnd::Kind::not_started;
    };
    EXPECT_EXIT(std::exit(abandoned() ? 0 : 1), testing::ExitedWithCode(0), "");
}

TEST(ChildProcess, KeepsTheEndOfLongOutput) {
    const ChildEnd end = shell("yes abcdefg | head -c 3000000; echo last");
    EXPECT_EQ(end.kind, ChildEnd::Kind::exited);
    EXPECT_LE(end.output.size(), 1u << 16);
    EXPECT_TRUE(end.output.ends_with("last\n"));
}

TEST(ChildProcess, BlocksNoSignalOfTheChild) {
    sigset_t blocked, before;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &blocked, &before);
    const ChildEnd end = shell("kill -TERM $$; echo survived");
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    EXPECT_EQ(end.kind, ChildEnd::Kind::killed);
    EXPECT_EQ(end.code, SIGTERM);
}

}   // namespace
}   // namespace meshfolio
