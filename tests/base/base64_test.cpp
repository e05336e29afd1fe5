#include "base/base64.h"

#include <gtest/gtest.h>

#include <map>

namespace meshfolio {
namespace {

TEST(Base64, EncodesAndDecodesAsRfc4648) {
    const std::map<std::string, std::string> vectors{{"", ""},        {"f", "Zg=="},          {"fo", "Zm8="},
                                                     {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}, {std::string("\xff\xef\0", 3), "/+8A"}};
    for (const auto& [bytes, text] : vectors) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(from_base64(text), bytes);
    }
}

TEST(Base64, DamagedTextDecodesToNothing) {
    for (const char* damaged : {"Zg", "Zg=", "Zm9*", "Zm9vYg=a"}) EXPECT_EQ(from_base64(damaged), "") << damaged;
}

TEST(Base64, PartsEncodedSeparatelyDecodeAsOne) {
    const std::string bytes("\0\1meshfolio\xff\xfe", 13);
    for (std::size_t first = 0; first <= bytes.size(); ++first) {
        for (std::size_t second = first; second <= bytes.size(); ++second) {
            const std::string text =
                base64(bytes.substr(0, first)) + "\n " + base64(bytes.substr(first, second - first)) + base64(bytes.substr(second));
            for (std::size_t count = 0; count <= bytes.size(); ++count)
                EXPECT_EQ(from_base64_parts(text, count), bytes.substr(0, count)) << text;
        }
    }
    for (const char* damaged : {"Zm9=", "Zm9v=", "Zg===", "Zm9*Zm9v", "Zm9v-"})
        EXPECT_LT(from_base64_parts(damaged, 6).size(), 6U) << damaged;
}

}   // namespace
}   // namespace meshfolio
