#include "report/document.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/test_tools.h"

namespace meshfolio::report {
namespace {

TEST(Check, WhatRoundingMayHaveMovedDecidesNothing) {
    const Check off = check_near("", 1, 1.2, 0.1);
    EXPECT_EQ(within_rounding(off, 0.11).status, Check::Status::undecided);
    EXPECT_TRUE(within_rounding(off, 0.09).failed());
    EXPECT_TRUE(within_rounding(check_at_most("", 1, 1.2, 0), 0.1).failed());
    EXPECT_EQ(within_rounding(check_at_least("", 1, 0.9, 0), 0.2).status, Check::Status::undecided);
    EXPECT_TRUE(within_rounding(check_near("", 1, 1.05, 0.1), 1).passed()) << "what passes is not taken back";
    EXPECT_TRUE(within_rounding(check_near("", 1, std::nan(""), 0.1), 1).failed());
}

TEST(Check, NearIsWithinTheTolerance) {
    EXPECT_TRUE(check_near("", 1, 1.09, 0.1).passed());
    EXPECT_TRUE(check_near("", 1, 1, 0).passed());
    EXPECT_FALSE(check_near("", 1, 1.11, 0.1).passed());
    EXPECT_FALSE(check_near("", 1, 0.89, 0.1).passed());
}

TEST(Check, LimitsHoldOnOneSide) {
    EXPECT_TRUE(check_at_most("", 1, -5).passed());
    EXPECT_TRUE(check_at_most("", 1, 1.05, 0.1).passed());
    EXPECT_FALSE(check_at_most("", 1, 1.05).passed());
    EXPECT_TRUE(check_at_least("", 1, 5).passed());
    EXPECT_TRUE(check_at_least("", 1, 0.95, 0.1).passed());
    EXPECT_FALSE(check_at_least("", 1, 0.95).passed());
}

TEST(Check, UndefinedNeverPasses) {
    for (const auto& make : {check_near, check_at_most, check_at_least}) {
        EXPECT_FALSE(make("", 1, undefined, 1e300, "").passed());
        EXPECT_FALSE(make("", undefined, 1, 1e300, "").passed());
        EXPECT_FALSE(make("", 1, 1, undefined, "").passed());
    }
}

TEST(Check, UndecidedIsNeitherPassedNorFailedAndSaysWhy) {
    const Check check = undecided(check_at_most("", 1, 0.5, 0, "half of it"), "rounding");
    EXPECT_FALSE(check.passed());
    EXPECT_FALSE(check.failed());
    EXPECT_EQ(check.note, "rounding; half of it");
    EXPECT_EQ(words_of(undecided(check_at_most("", std::nan(""), std::nan("")), "nothing to measure")), "measured –, expected –");
}

TEST(Check, ScoresCountTheThreeStatesApart) {
    const Check passes = check_near("", 1, 1, 0), fails = check_near("", 1, 2, 0);
    Score score = score_of({passes, fails, passes, undecided(fails, "why"), undecided(passes, "why")});
    EXPECT_EQ(score.passed, 2u);
    EXPECT_EQ(score.failed, 1u);
    EXPECT_EQ(score.undecided, 2u);
    EXPECT_EQ(words_of(score), "2 of 5 checks passed, 1 failed, 2 undecided");
    score += score_of({passes});
    EXPECT_EQ(score.total(), 6u);
    EXPECT_EQ(words_of(score_of({passes})), "1 of 1 checks passed");
}

TEST(Text, JoinsAndExtends) {
    Text t = text("a ", strong("b"), std::string(" c"));
    extend(t, " d", text(ref("q1")));
    EXPECT_EQ(t, (Text{{Run::Kind::plain, "a "}, strong("b"), {Run::Kind::plain, " c d"}, ref("q1")})) << "plain text joins plain text";
    EXPECT_EQ(plain(t), "a b c dq1");
}

}   // namespace
}   // namespace meshfolio::report
