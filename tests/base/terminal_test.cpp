#include "base/terminal.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace meshfolio {
namespace {

std::size_t code_points(const std::string& text) {
    std::size_t n = 0;
    for (const char c : text) n += (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
    return n;
}

std::vector<std::string> words_in(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::string random_text(std::mt19937& random) {
    std::string text;
    for (unsigned i = random() % 60; i > 0; --i) {
        for (unsigned letters = 1 + random() % 14; letters > 0; --letters) text += random() % 5 == 0 ? "μ" : "a";
        const unsigned gap = random() % 12;
        text += gap == 0 ? "\n    " : gap == 1 ? "\n" : gap == 2 ? "      " : " ";
    }
    return text;
}

TEST(Wrapped, NoLineIsWiderAndNoWordIsLost) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const std::string text = random_text(random);
        const int width = 1 + static_cast<int>(random() % 100);
        const std::string shown = wrapped(text, width);
        EXPECT_EQ(words_in(shown), words_in(text));
        std::istringstream lines(shown);
        for (std::string line; std::getline(lines, line);) {
            if (words_in(line).size() > 1) {
                EXPECT_LE(code_points(line), static_cast<std::size_t>(width)) << line;
            }
        }
    }
}

TEST(Wrapped, TextThatFitsIsUnchanged) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 200; ++trial) {
        const std::string text = random_text(random);
        EXPECT_EQ(wrapped(text, 10000), text);
    }
}

TEST(Wrapped, ContinuationsAreIndentedAsTheLastColumn) {
    EXPECT_EQ(wrapped("  --out DIR   folder of the report", 28), "  --out DIR   folder of the\n              report");
    EXPECT_EQ(wrapped("meshfolio: one two three", 16), "meshfolio: one\n  two three");
}

TEST(Shortened, EndsAfterAWholeWordWithAnEllipsis) {
    EXPECT_EQ(shortened("reading bunny.off", 17), "reading bunny.off");
    EXPECT_EQ(shortened("reading bunny.off", 16), "reading …");
    for (int columns = 0; columns < 30; ++columns)
        EXPECT_LE(code_points(shortened("μμμμμμμμ μμμμμμμμμμμμ of a long name", columns)), static_cast<std::size_t>(columns));
}

TEST(Ink, APipeGetsPlainText) {
    ::testing::internal::CaptureStdout();   // into a file
    EXPECT_EQ(inked(Ink::red, "x"), "x");
    EXPECT_EQ(for_terminal(std::string(300, 'x') + " y"), std::string(300, 'x') + " y");
    ::testing::internal::GetCapturedStdout();
}

}   // namespace
}   // namespace meshfolio
