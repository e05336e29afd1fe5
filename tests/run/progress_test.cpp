#include "run/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

using namespace meshfolio::run;

namespace {

int code_points(const std::string& text) {
    int n = 0;
    for (const char c : text) n += (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
    return n;
}

}   // namespace

TEST(ProgressLine, FillsInProportion) {
    EXPECT_EQ(progress_line(0, "", 80).find('#'), std::string::npos);
    EXPECT_NE(progress_line(0.5, "", 80).find("[##########·"), std::string::npos);
    EXPECT_NE(progress_line(1, "", 80).find("[####################] 100 %"), std::string::npos);
    EXPECT_EQ(progress_line(7, "x", 80), progress_line(1, "x", 80));
    EXPECT_EQ(progress_line(-7, "x", 80), progress_line(0, "x", 80));
}

TEST(SecondsLeft, BeginAsEstimatedAndEndWithTheTimeTaken) {
    EXPECT_EQ(seconds_left(60, 0, 0), 60);
    EXPECT_EQ(seconds_left(60, 90, 1), 0);
    for (const double share : {0.1, 0.5, 0.9}) EXPECT_NEAR(seconds_left(60, 60 * share, share), 60 * (1 - share), 1e-9);
    EXPECT_GT(seconds_left(60, 60, 0.5), 30) << "a slower machine";
}

TEST(SecondsLeft, WithoutAnEstimateAreThoseOfWhatIsDone) {
    EXPECT_EQ(seconds_left(0, 5, 0), 0) << "not known yet";
    for (const double share : {0.1, 0.5, 0.9, 1.0}) EXPECT_NEAR(seconds_left(0, 60 * share, share), 60 * (1 - share), 1e-9);
}

TEST(ProgressLine, NeverWiderThanTheTerminal) {
    for (const int width : {0, 1, 10, 25, 40, 79}) {
        EXPECT_LE(code_points(progress_line(0.3, "μμμμμμμμμμ of a very long mesh name that does not fit at all", width)), width);
    }
}

TEST(ProgressLine, NamesOfMeshesCannotSteerTheTerminal) {
    EXPECT_EQ(progress_line(0.3, "\x1b[2J\n", 80).find_first_of("\x1b\n"), std::string::npos);
}

TEST(StageLine, KeepsTheSecondsHoweverNarrowTheTerminal) {
    EXPECT_EQ(stage_line("inspect: reading bunny.off", -1, 12, 80), "inspect: reading bunny.off, 12 s");
    EXPECT_EQ(stage_line("spectrum", 0.456, 3, 80), "spectrum, 45 %, 3 s");
    EXPECT_EQ(stage_line("inspect: reading bunny.off", -1, 12, 20), "inspect: …, 12 s");
    EXPECT_LE(code_points(stage_line("μμμμμμμμμμμμ", 0.5, 100, 5)), 5);
    EXPECT_EQ(stage_line("\x1b[2J\n", -1, 3, 80).find_first_of("\x1b\n"), std::string::npos);
}

TEST(ProgressDisplay, WithoutATerminalItPrintsLines) {
    ::testing::internal::CaptureStderr();
    {
        ProgressDisplay display(false);
        display.step("q1: begins");
        display.advance(0.5);
        display.milestone("q1: answered");
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "meshfolio: q1: answered\n");
}

TEST(ProgressDisplay, OnATerminalItRedrawsOneLineAndClearsIt) {
    ::testing::internal::CaptureStderr();
    {
        ProgressDisplay display(true);
        for (int i = 0; i < 1000; ++i) display.step("step " + std::to_string(i));
        display.advance(1);
    }
    const std::string shown = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(shown.find('\n'), std::string::npos);
    EXPECT_LT(std::count(shown.begin(), shown.end(), '\r'), 30) << "at most ten times a second";
    EXPECT_TRUE(shown.ends_with("\r\x1b[K"));
}

TEST(ProgressDisplay, TakesCallsFromManyThreads) {
    ::testing::internal::CaptureStderr();
    {
        ProgressDisplay display(false);
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t)
            threads.emplace_back([&display] {
                for (int i = 0; i < 50; ++i) display.milestone("line");
            });
    }
    const std::string shown = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(shown.size(), 200 * std::string("meshfolio: line\n").size());
}
