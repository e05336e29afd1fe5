#include "base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace meshfolio;

TEST(NumberText, BoundsAreRoundedOutwards) {
    EXPECT_EQ(rounded_down(1.2345, 3), 1.23);
    EXPECT_EQ(rounded_up(1.2345, 3), 1.24);
    EXPECT_EQ(rounded_down(1.9999, 3), 1.99);
    EXPECT_EQ(rounded_up(9.999e-7, 2), 1e-6);
    // Just below a power of ten the last digit is a tenth of that just above.
    EXPECT_EQ(rounded_down(0.9999999999999976, 4), 0.9999);
    EXPECT_EQ(rounded_down(9.9996, 4), 9.999);
    EXPECT_EQ(rounded_up(-0.99996, 4), -0.9999);
    EXPECT_EQ(rounded_down(1e3, 4), 1e3);
    EXPECT_EQ(rounded_down(-1.234, 3), -1.24);
    EXPECT_EQ(rounded_down(0.5, 3), 0.5);
    EXPECT_EQ(rounded_up(0, 3), 0);
    for (double x = 1e-9; x < 1e9; x *= 1.37) {
        for (const int digits : {1, 4, 10}) {
            EXPECT_LE(rounded_down(x, digits), x);
            EXPECT_GE(rounded_up(x, digits), x);
            EXPECT_LE(rounded_up(x, digits) - rounded_down(x, digits), 10.0000001 * x * std::pow(10.0, 1 - digits));
        }
    }
}

TEST(NumberText, ExactTextReadsBackAsTheSameNumber) {
    for (const double x : {0.1, 1.0 / 3, 6.02e23, -5e-324, 1e308, 123456789.0}) EXPECT_EQ(parse_number(exact_text(x)), x);
    EXPECT_EQ(exact_text(std::nan("")), "");
}

TEST(NumberText, ReadableRoundsToSignificantDigits) {
    EXPECT_EQ(readable(0.0123456), "0.0123");
    EXPECT_EQ(readable(43243, 5), "43\u202f243");
    EXPECT_EQ(readable(1234), "1234");
    EXPECT_EQ(readable(0.99999), "1.00");
    EXPECT_EQ(readable(-1.23456e-7), "\u22121.23\u202f×\u202f10⁻⁷");
    EXPECT_EQ(readable(0), "0");
    EXPECT_EQ(readable_percent(0.1234), "12.3\u202f%");
}

// Prose and tables follow one rule, readable() too.
TEST(NumberText, CountsOfFiveDigitsAndMoreAreGrouped) {
    EXPECT_EQ(readable_count(0), "0");
    EXPECT_EQ(readable_count(9999), "9999");
    EXPECT_EQ(readable_count(40962), "40\u202f962");
    EXPECT_EQ(readable_count(-1234567), "\u22121\u202f234\u202f567");
    EXPECT_EQ(readable_count(12345678901), "12\u202f345\u202f678\u202f901");
}

TEST(NumberText, ScientificRoundsUpIntoTheNextPower) {
    EXPECT_EQ(scientific_text(9.996e-4, 3), "1.00\u202f×\u202f10⁻³");
    EXPECT_EQ(scientific_text(-1234.0, 2), "\u22121.2\u202f×\u202f10³");
    EXPECT_EQ(scientific_text(0, 2), "0");
}

TEST(NumberText, PlainTextHasNoTypography) {
    EXPECT_EQ(plain_text(-0.5), "-0.5");
    EXPECT_EQ(plain_text(1.25e-9), "1.25e-9");
    EXPECT_EQ(plain_text(100000), "100000");
}

TEST(NumberText, BriefTextHasNoMoreDigitsThanItNeeds) {
    EXPECT_EQ(brief_text(2, 4), "2");
    EXPECT_EQ(brief_text(0.01, 4), "0.01");
    EXPECT_EQ(brief_text(0.12345, 4), "0.1235");
    EXPECT_EQ(brief_text(1e-6, 4), "1\u202f×\u202f10⁻⁶");
    EXPECT_EQ(brief_text(120, 4), "120");
    EXPECT_EQ(brief_text(std::nan(""), 4), "–");
}

TEST(NumberText, ParseNumberTakesDecimalNumbersOnly) {
    for (const char* good : {"1", "+1", "-.5", "0.", "1E3", "1e-400", "-0.0"}) EXPECT_TRUE(parse_number(good)) << good;
    for (const char* bad : {"", "+", "-", "--1", "+-1", "nan", "inf", "-inf", "0x1", "1,5", "1.2.3", "1e400", "1 ", " 1", "abc", "1e"}) {
        EXPECT_FALSE(parse_number(bad)) << bad;
    }
    EXPECT_EQ(parse_number("4.9e-324"), std::numeric_limits<double>::denorm_min());
}

TEST(NumberText, ParseIntegerRefusesWhatDoesNotFit) {
    EXPECT_EQ(parse_integer("-2147483648"), -2147483648LL);
    for (const char* bad : {"", "4.0", "0x4", "9223372036854775808", "1e3", "++1"}) EXPECT_FALSE(parse_integer(bad)) << bad;
}
