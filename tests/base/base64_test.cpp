#include "base/base64.h"

#include <gtest/gtest.h>

#include <map>

namespace meshfolio {
namespace {

TEST(Base64, IsThatOfRfc4648BothWays) {
    const std::map<std::string, std::string> vectors{{"", ""},        {"f", "Zg=="},          {"fo", "Zm8="},
                                                     {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}, {std::string("\xff\xef\0", 3), "/+8A"}};
    for (const auto& [bytes, text] : vectors) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(from_base64(text), bytes);
    }
}

TEST(Base64, OfDamagedTextNothingIsRead) {
    for (const char* damaged : {"Zg", "Zg=", "Zm9*", "Zm9vYg=a"}) EXPECT_EQ(from_base64(damaged), "") << damaged;
}

}   // namespace
}   // namespace meshfolio
