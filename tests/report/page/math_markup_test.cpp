#include "report/page/math_markup.h"

#include <gtest/gtest.h>

namespace meshfolio::report {
namespace {

/// λ_crit → "<λ>_(crit)": variables in <>, indices in _(), exponents in ^().
std::string sketch(const std::string& math) {
    std::string text;
    for (const MathPart& part : math_parts(math)) {
        switch (part.kind) {
            case MathPart::Kind::upright:
                text += part.text;
                break;
            case MathPart::Kind::variable:
                text += "<" + part.text + ">";
                break;
            case MathPart::Kind::subscript:
                text += "_(" + part.text + ")";
                break;
            case MathPart::Kind::superscript:
                text += "^(" + part.text + ")";
                break;
        }
    }
    return text;
}

TEST(MathMarkup, IndicesAndExponents) {
    EXPECT_EQ(sketch("λ_crit = 2/μ_max"), "<λ>_(crit) = 2/<μ>_(max)");
    EXPECT_EQ(sketch("h^2 + x_{i,j}"), "<h>^(2) + <x>_(i,j)");
    EXPECT_EQ(sketch("k^−1/2"), "<k>^(−1)/2");
    EXPECT_EQ(sketch("ΔX"), "Δ<X>");
}

TEST(MathMarkup, FunctionsAndWordsAreUpright) {
    EXPECT_EQ(sketch("sin v du"), "sin <v> <du>");
    EXPECT_EQ(sketch("volume"), "volume");
}

TEST(MathMarkup, OddInputsKeepTheirCharacters) {
    EXPECT_EQ(sketch(""), "");
    EXPECT_EQ(sketch("_"), "_");
    EXPECT_EQ(sketch("_a"), "_<a>");
    EXPECT_EQ(sketch("a_"), "<a>_");
    EXPECT_EQ(sketch("x_ y"), "<x>_ <y>");
    EXPECT_EQ(sketch("x^{open"), "<x>^(open)");
    EXPECT_EQ(sketch("φ_λ"), "<φ>_(λ)");
}

TEST(MathMarkup, OnlyGreekLettersWithAnIndexAreSymbolsInProse) {
    const Text runs = prose("growth at 1.01 λ_crit on fandisk_ns");
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[1].kind, Run::Kind::math);
    EXPECT_EQ(runs[1].content, "λ_crit");
    EXPECT_EQ(runs[2].content, " on fandisk_ns");
    EXPECT_EQ(prose("λ_ and μ").size(), 1u);
    EXPECT_EQ(plain(prose("κ_n over θ, \xff_x")), "κ_n over θ, \xff_x");
}

}   // namespace
}   // namespace meshfolio::report
