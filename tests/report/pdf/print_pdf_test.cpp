#include "report/pdf/print_pdf.h"

#include <gtest/gtest.h>

namespace meshfolio::report {
namespace {

using namespace std::string_literals;

const std::string head = "\xff\xd8\xff\xe0\x00\x04xx\xff\xc0\x00\x05\x08\x01\x02\xff\xda\x00\x03\x01"s, end = "\xff\xd9";

TEST(DraftPicture, KeepsTheHeadersAndNothingThatIsDrawn) {
    EXPECT_EQ(draft_of_jpeg(head + "drawn\xff\x00 and more"s + end), head + end);
    EXPECT_EQ(draft_of_jpeg(head + end), head + end);
    EXPECT_EQ(draft_of_jpeg(head), head + end);
}

TEST(DraftPicture, WhatIsNoWholeHeaderStaysAsItIs) {
    for (const std::string& other :
         {""s, "\xff\xd8"s, "\x89PNG\r\n"s, head.substr(0, head.size() - 1), head.substr(0, 9), "\xff\xd8\xff\xe0\xff\xff"s})
        EXPECT_EQ(draft_of_jpeg(other), other);
}

}   // namespace
}   // namespace meshfolio::report
