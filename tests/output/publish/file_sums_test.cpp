#include "output/publish/publish.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "damaged_bytes.h"

using namespace meshfolio;

namespace {

const std::string digest(64, 'a');

std::string refusal(const std::string& text) {
    try {
        output::parse_sums(text, "out/SHA256SUMS");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}   // namespace

TEST(FileSums, AreParsedByPathWithTheirLines) {
    const auto sums = output::parse_sums(digest + "  index.html\n" + std::string(64, '0') + "  images/two  spaces.png\n", "SHA256SUMS");
    ASSERT_EQ(sums.size(), 2u);
    EXPECT_EQ(sums.at("index.html").digest, digest);
    EXPECT_EQ(sums.at("images/two  spaces.png").line, 2);
    EXPECT_TRUE(output::parse_sums("", "SHA256SUMS").empty());
}

TEST(FileSums, ALineInAnotherFormatIsRefusedByNumber) {
    for (const std::string& line :
         {digest + " index.html", digest + "  ", digest, "g" + digest.substr(1) + "  a", std::string("\n"), std::string("not a list")}) {
        EXPECT_EQ(refusal(digest + "  a\n" + line + "\n").rfind("out/SHA256SUMS:2: is no line of sha256sum", 0), 0u) << line;
    }
}

TEST(FileSums, DamagedListsAreParsedOrRefusedWithALine) {
    testing_tools::for_each_damage(digest + "  a\n" + digest + "  b/c\n", [](const std::string& damaged) {
        try {
            output::parse_sums(damaged, "out/SHA256SUMS");
        } catch (const InputError& error) {
            EXPECT_TRUE(testing_tools::is_one_line_about("out/SHA256SUMS:", error.what()));
        }
    });
}
