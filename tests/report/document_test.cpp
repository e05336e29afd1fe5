#include "report/document.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

TEST(Check, FailuresWithinRoundingAreUndecided) {
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

TEST(Check, IdsAreUniqueAndMadeOfPlainWords) {
    Section section;
    section.id = "q5";
    for (const char* name : {"Energy falls on Cube", "energy falls: on cube", "energy falls on cube 2", "2λ ≤ 2", "2", "∞"})
        section.checks.push_back(check_near(name, 1, 1, 0));
    EXPECT_EQ(check_ids(section), (std::vector<std::string>{"q5-energy-falls-on-cube", "q5-energy-falls-on-cube-2",
                                                            "q5-energy-falls-on-cube-2-2", "q5-2-lambda-2", "q5-2", "q5-check"}));
}

TEST(JUnit, HasACaseForEachCheckAndForEachMissingSection) {
    Section good, broken, left;
    good.id = "q1";
    good.title = "A & B";
    broken.id = "q2";
    left.id = "q3";
    good.checks = {check_near("a", 1, 1, 0), check_near("b", 1, 2, 0), undecided(check_near("c", 1, 2, 0), "why")};
    good.timings = {{"whole question", 61.0625}};
    broken.status = Status::failed;
    broken.failure = "<no>\x01";
    left.status = Status::skipped;
    Document document;
    document.sections = {good, broken, left};
    const std::string xml = write_junit(document, true), bare = write_junit(document, false);
    for (const char* words :
         {"name=\"q1: A &amp; B\" id=\"0\"", "tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\" time=\"61.063\"",
          "name=\"q1-a\" time=\"0\"/>", "<failure type=\"check\" message=\"b: measured 2, expected 1\"/>",
          "<skipped message=\"c: measured 2, expected 1 (why)\"/>", "message=\"&lt;no&gt;\\x01\"",
          "tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\"", "tests=\"1\" failures=\"0\" errors=\"0\" skipped=\"1\""})
        EXPECT_NE(xml.find(words), std::string::npos) << words << " in\n" << xml;
    EXPECT_EQ(bare.find("61"), std::string::npos);
}

TEST(Text, JoinsAndExtends) {
    Text t = text("a ", strong("b"), std::string(" c"));
    extend(t, " d", text(ref("q1")));
    EXPECT_EQ(t, (Text{{Run::Kind::plain, "a "}, strong("b"), {Run::Kind::plain, " c d"}, ref("q1")})) << "plain text joins plain text";
    EXPECT_EQ(plain(t), "a b c dq1");
}

}   // namespace
}   // namespace meshfolio::report
